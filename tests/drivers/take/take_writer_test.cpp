#include "drivers/take/take_writer.h"

#include <gtest/gtest.h>

#include <array>

#include "core/errors.h"
#include "drivers/take/mask_video.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/take_table.h"
#include "drivers/take/video_reader.h"
#include "tests/support/images.h"
#include "tests/support/setup_error.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using testing::ReadText;
using testing::SmallPicture;
using testing::SmallTake;

class WrittenTake : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  TakeLayout layout_{folder_.path() / "take"};
  TakeLayout partial_{folder_.path() / "take.partial"};
  SmallTake take_;
};

TEST_F(WrittenTake, SaysWhatItIs) {
  WriteSmallTake(layout_.folder, take_);
  EXPECT_EQ(ReadText(layout_.Description()),
            "name = \"small\"\nfps_nominal = 25.0\ncameras = [\"cam1\", \"cam2\", \"cam3\"]\n"
            "source = \"a test\"\n");
}

TEST_F(WrittenTake, HasItsNameOnlyOnceItIsComplete) {
  TakeWriter writer(layout_.folder, SmallDescription(take_));
  EXPECT_FALSE(std::filesystem::exists(layout_.folder));
  EXPECT_TRUE(std::filesystem::exists(partial_.folder));
  writer.Finish();
  EXPECT_TRUE(std::filesystem::exists(layout_.folder));
  EXPECT_FALSE(std::filesystem::exists(partial_.folder));
}

TEST_F(WrittenTake, LiesInItsFolderHoweverThatIsWritten) {
  WriteSmallTake(folder_.path() / "." / "absent" / ".." / "take" / "", take_);
  EXPECT_TRUE(std::filesystem::exists(layout_.Description()));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
  EXPECT_THROW(WriteSmallTake("", take_), SetupError);
}

TEST_F(WrittenTake, NamesThatAreNoUtf8LeaveADescriptionThatOpens) {
  TakeDescription description = SmallDescription(take_);
  description.name = "a\xff\x1b\"b";
  TakeWriter(layout_.folder, description).Finish();
  EXPECT_TRUE(
      ReadText(layout_.Description()).starts_with("name = \"a\\U0000fffd\\U0000001b\\\"b\"\n"));
}

TEST_F(WrittenTake, NeverReplacesAnotherOne) {
  WriteSmallTake(layout_.folder, take_);
  EXPECT_THROW(TakeWriter(layout_.folder, SmallDescription(take_)), SetupError);
  EXPECT_THROW(TakeWriter(layout_.folder / "", SmallDescription(take_)), SetupError);
  const TakeLayout other{folder_.path() / "other"};
  std::filesystem::create_directory(other.folder.string() + ".partial");
  EXPECT_EQ(testing::SetupErrorOf([&] { TakeWriter(other.folder, SmallDescription(take_)); }),
            other.folder.string() +
                ": other.partial beside it is being written, or is of a command that was killed; "
                "expected another name, or remove it");
}

TEST_F(WrittenTake, InterruptedRecordingKeepsItsWholeFrames) {
  {
    TakeWriter writer(layout_.folder, SmallDescription(take_));
    writer.WriteFrame(0, SmallPicture(take_, 0, 0).view(), 10);
    writer.WriteFrame(0, SmallPicture(take_, 0, 1).view(), 20);
  }
  EXPECT_EQ(ReadTakeTable(partial_.Table("cam1")).rows.size(), 2u);
  VideoReader video(partial_.Video("cam1"));
  ImageView<const Bgr> image;
  EXPECT_EQ(video.Read(image), VideoStatus::kFrame);
  EXPECT_EQ(video.Read(image), VideoStatus::kFrame);
  EXPECT_TRUE(testing::SamePixels<Bgr>(image, SmallPicture(take_, 0, 1).view()));
}

TEST_F(WrittenTake, SkippedFrameLeavesAGapInTheNumbers) {
  TakeWriter writer(layout_.folder, SmallDescription(take_));
  writer.WriteFrame(1, SmallPicture(take_, 1, 0).view(), 10);
  writer.SkipFrames(1, 1);
  writer.WriteFrame(1, SmallPicture(take_, 1, 2).view(), 30);
  writer.Finish();
  EXPECT_EQ(ReadText(layout_.Table("cam2")), "frame,timestamp_ns\n0,10\n2,30\n");
}

TEST_F(WrittenTake, AnglesComeBackToTheLastBit) {
  take_.heads = true;
  const PanTiltAngles angles{1.0 / 3, -0.1};
  TakeWriter writer(layout_.folder, SmallDescription(take_));
  writer.WriteFrame(0, SmallPicture(take_, 0, 0).view(), 10, angles);
  writer.WriteBackground(0, SmallPicture(take_, 0, 9).view(), 5, angles);
  writer.Finish();
  EXPECT_EQ(ReadTakeTable(layout_.Table("cam1")).rows.at(0).angles, angles);
  EXPECT_EQ(ReadTakeTable(layout_.BackgroundTable("cam1")).rows.at(0).angles, angles);
}

TEST_F(WrittenTake, WhatWasNeverSeenEmptyIsBesideTheBackground) {
  Silhouette unseen(take_.width_px, take_.height_px);
  for (int x = 3; x < 9; ++x) unseen.Set(x, 5);
  TakeWriter writer(layout_.folder, SmallDescription(take_));
  writer.WriteUnseen(1, unseen);
  writer.WriteBackground(1, SmallPicture(take_, 1, 9).view(), 5);
  writer.Finish();
  EXPECT_EQ(layout_.BackgroundUnseen("cam2"), layout_.folder / "background" / "cam2.unseen.mkv");
  EXPECT_EQ(ReadMask(layout_.BackgroundUnseen("cam2")).words(), unseen.words());
}

TEST_F(WrittenTake, TruthHasOneRowAFrame) {
  TakeWriter writer(layout_.folder, SmallDescription(take_));
  writer.SetTruthColumns({{"neck", "knee_l"}, {"head"}, {"heel_l"}});
  const std::array<Vector3, 2> points = {Vector3(1, -2.5, 1000.1234), Vector3(0, 1e-9, 3)};
  const std::array<Vector3, 1> rotations = {Vector3(0, 0.25, -3)};
  const std::array<bool, 1> contacts = {true};
  writer.WriteTruth(0, 10, {points, rotations, contacts});
  writer.WriteTruth(1, 20, {points, rotations, contacts});
  writer.WriteTruthSizes({1750, 80.5, {{"torso_mm", 588.25}, {"calf_mm", 500}}});
  writer.Finish();
  const std::string row =
      ",1.000,-2.500,1000.123,0.000,0.000,3.000,0.000000,0.250000,-3.000000,1\n";
  EXPECT_EQ(ReadText(layout_.TruthTable()),
            "frame,timestamp_ns,neck_x_mm,neck_y_mm,neck_z_mm,knee_l_x_mm,knee_l_y_mm,knee_l_z_mm,"
            "head_rotation_x_rad,head_rotation_y_rad,head_rotation_z_rad,contact_heel_l\n"
            "0,10" +
                row + "1,20" + row);
  EXPECT_EQ(ReadText(layout_.TruthSizes()),
            "stature_mm = 1750.0\nankle_to_sole_mm = 80.5\n\n[lengths]\ntorso_mm = 588.25\n"
            "calf_mm = 500.0\n");
}

TEST_F(WrittenTake, MasksLieBesideTheVideos) {
  TakeWriter writer(layout_.folder, SmallDescription(take_));
  writer.WriteMask(2, Image<std::uint8_t>(take_.width_px, take_.height_px, 255).view());
  writer.Finish();
  EXPECT_EQ(VideoReader(layout_.Mask("cam3")).width_px(), take_.width_px);
}

TEST_F(WrittenTake, CameraNamesThatAreNoFileNamesAreRefused) {
  for (const char* name : {"", "../cam1", "a/b", "cam 1", "cam1.x"}) {
    TakeDescription description = SmallDescription(take_);
    description.cameras[0].name = name;
    EXPECT_THROW(TakeWriter(layout_.folder, description), SetupError) << name;
  }
  TakeDescription description = SmallDescription(take_);
  description.cameras[1].name = description.cameras[0].name;
  EXPECT_THROW(TakeWriter(layout_.folder, description), SetupError);
  EXPECT_FALSE(std::filesystem::exists(partial_.folder));
}

TEST_F(WrittenTake, SameCallsGiveTheSameBytes) {
  WriteSmallTake(layout_.folder, take_);
  const TakeLayout again{folder_.path() / "again"};
  WriteSmallTake(again.folder, take_);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(layout_.folder)) {
    if (!entry.is_regular_file()) continue;
    const auto name = std::filesystem::relative(entry.path(), layout_.folder);
    EXPECT_EQ(ReadText(entry.path()), ReadText(again.folder / name)) << name;
  }
}

}  // namespace
}  // namespace mocap

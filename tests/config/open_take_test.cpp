#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "config/open_studio.h"
#include "core/errors.h"
#include "drivers/take/mask_video.h"
#include "drivers/take/take_layout.h"
#include "tests/support/gray_video.h"
#include "tests/support/images.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ReplaceInFile;
using testing::SmallTake;
using testing::WriteText;

std::vector<std::string> NamesOf(const Studio& studio) {
  std::vector<std::string> names;
  for (const StudioCamera& camera : studio.cameras) names.push_back(camera.calibration.name);
  return names;
}

int CountFrames(CameraDriver& driver) {
  driver.Start();
  Frame frame;
  int frames = 0;
  while (driver.Grab(frame, milliseconds(0)) == GrabStatus::kFrame) ++frames;
  return frames;
}

class OpenedTake : public ::testing::Test {
 protected:
  std::string ErrorOnOpening(const TakeOptions& options = {}) const {
    try {
      OpenTake(layout_.folder, options);
    } catch (const SetupError& error) {
      return error.what();
    }
    return "none";
  }

  testing::TemporaryFolder folder_;
  TakeLayout layout_{folder_.path() / "take"};
  SmallTake take_;
};

TEST_F(OpenedTake, GivesWhatWasWritten) {
  WriteSmallTake(layout_.folder, take_);
  const Studio studio = OpenTake(layout_.folder, {});
  EXPECT_EQ(studio.name, "small");
  EXPECT_EQ(studio.fps_nominal, 25);
  EXPECT_THAT(NamesOf(studio), ElementsAre("cam1", "cam2", "cam3"));
  for (int camera = 0; camera < take_.cameras; ++camera) {
    CameraDriver& driver = *studio.cameras[camera].driver;
    driver.Start();
    Frame frame;
    for (int i = 0; i < take_.frames; ++i) {
      ASSERT_EQ(driver.Grab(frame, milliseconds(0)), GrabStatus::kFrame);
      EXPECT_EQ(frame.capture_ns, take_.TimeNs(camera, i));
      EXPECT_TRUE(testing::SamePixels<Bgr>(frame.image, SmallPicture(take_, camera, i).view()));
    }
    EXPECT_EQ(driver.Grab(frame, milliseconds(0)), GrabStatus::kEnd);
  }
}

TEST_F(OpenedTake, BackgroundComesWithTheAnglesOfTheHead) {
  take_.heads = true;
  WriteSmallTake(layout_.folder, take_);
  const Studio studio = OpenTake(layout_.folder, {});
  const std::vector<BackgroundFrame> background = studio.cameras[1].background();
  ASSERT_EQ(background.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(background[i].angles, take_.Angles(1, i));
    EXPECT_TRUE(testing::SamePixels<Bgr>(background[i].image.view(),
                                         SmallPicture(take_, 1, 100 + i).view()));
  }
}

TEST_F(OpenedTake, EachPictureOfTheBackgroundKnowsWhatWasNeverSeenEmpty) {
  WriteSmallTake(layout_.folder, take_);
  Silhouette unseen(take_.width_px, take_.height_px);
  unseen.Set(7, 3);
  WriteMask(layout_.BackgroundUnseen("cam2"), unseen);
  const Studio studio = OpenTake(layout_.folder, {});
  for (const BackgroundFrame& frame : studio.cameras[1].background())
    EXPECT_EQ(frame.unseen.words(), unseen.words());
  for (const BackgroundFrame& frame : studio.cameras[0].background())
    EXPECT_FALSE(frame.unseen.BoundingBox()) << "all of it is known";
}

TEST_F(OpenedTake, AMaskOfTheBackgroundThatDoesNotFitIsNamed) {
  WriteSmallTake(layout_.folder, take_);
  WriteMask(layout_.BackgroundUnseen("cam2"), Silhouette(take_.width_px / 2, take_.height_px));
  EXPECT_THAT(ErrorOnOpening({}), AllOf(HasSubstr("cam2.unseen.mkv: has pictures of "),
                                        HasSubstr("cam2 is calibrated for ")));
  fs::remove_all(layout_.folder);
  take_.heads = true;
  WriteSmallTake(layout_.folder, take_);
  WriteMask(layout_.BackgroundUnseen("cam2"), Silhouette(take_.width_px, take_.height_px));
  EXPECT_THAT(ErrorOnOpening({}),
              HasSubstr("cam2.unseen.mkv: cam2 is on a pan-tilt head; expected such a mask only"));
}

TEST_F(OpenedTake, ChosenCamerasKeepTheOrderOfTheTake) {
  WriteSmallTake(layout_.folder, take_);
  const TakeOptions options{.rate = ReplayRate::kFast, .loop = false, .cameras = {"cam3", "cam1"}};
  EXPECT_THAT(NamesOf(OpenTake(layout_.folder, options)), ElementsAre("cam1", "cam3"));
}

TEST_F(OpenedTake, UnknownCameraIsNamedWithThoseThatAreThere) {
  WriteSmallTake(layout_.folder, take_);
  const TakeOptions options{.rate = ReplayRate::kFast, .loop = false, .cameras = {"cam9"}};
  EXPECT_THAT(ErrorOnOpening(options), AllOf(HasSubstr("cam9"), HasSubstr("cam1, cam2, cam3")));
}

TEST_F(OpenedTake, CutOffVideoGivesAShorterRun) {
  WriteSmallTake(layout_.folder, take_);
  testing::CutFile(layout_.Video("cam2"), 0.5);
  const Studio studio = OpenTake(layout_.folder, {});
  EXPECT_EQ(CountFrames(*studio.cameras[0].driver), take_.frames);
  const int frames = CountFrames(*studio.cameras[1].driver);
  EXPECT_GE(frames, 4);
  EXPECT_LE(frames, 6);
}

TEST_F(OpenedTake, CutOffTableGivesAShorterRun) {
  WriteSmallTake(layout_.folder, take_);
  testing::CutFile(layout_.Table("cam2"), 0.5);
  const Studio studio = OpenTake(layout_.folder, {});
  const int frames = CountFrames(*studio.cameras[1].driver);
  EXPECT_GE(frames, 4);
  EXPECT_LE(frames, 6);
}

TEST_F(OpenedTake, InterruptedRecordingOpens) {
  {
    TakeWriter writer(layout_.folder, testing::SmallDescription({.cameras = 1}));
    writer.WriteBackground(0, SmallPicture(take_, 0, 50).view(), 1);
    for (int i = 0; i < 3; ++i)
      writer.WriteFrame(0, SmallPicture(take_, 0, i).view(), take_.TimeNs(0, i));
  }
  const Studio studio = OpenTake(layout_.folder.string() + ".partial", {});
  EXPECT_EQ(CountFrames(*studio.cameras[0].driver), 3);
}

TEST_F(OpenedTake, ACameraThatDeliveredNothingIsLeftOutUnlessItIsNamed) {
  {
    TakeWriter writer(layout_.folder, testing::SmallDescription({.cameras = 3}));
    for (int camera = 0; camera < 3; ++camera) {
      writer.WriteBackground(camera, SmallPicture(take_, camera, 50).view(), 1);
    }
    for (const int camera : {0, 2}) {
      for (int i = 0; i < 3; ++i) {
        writer.WriteFrame(camera, SmallPicture(take_, camera, i).view(), take_.TimeNs(camera, i));
      }
    }
    writer.Finish();
  }
  EXPECT_THAT(NamesOf(OpenTake(layout_.folder, {})), ElementsAre("cam1", "cam3"));
  EXPECT_THAT(ErrorOnOpening({.cameras = {"cam2"}}), HasSubstr("cam2.csv:1"));
  WriteText(layout_.Table("cam1"), "frame,timestamp_ns\n");
  WriteText(layout_.Table("cam3"), "frame,timestamp_ns\n");
  EXPECT_THAT(ErrorOnOpening(), HasSubstr("contains no frame of any camera (cam1, cam2, cam3)"));
}

/// Rows as they come when the unit of time is another.
std::string TableWithIntervals(std::int64_t interval) {
  std::string text = "frame,timestamp_ns\n";
  for (int i = 0; i < 5; ++i) {
    text += std::to_string(i) + ',' + std::to_string(1'000'000 + i * interval) + '\n';
  }
  return text;
}

TEST_F(OpenedTake, BeginsWhereItsDescriptionSays) {
  WriteSmallTake(layout_.folder, take_);
  const std::filesystem::path file = layout_.Description();
  const auto begin_at = [&](std::int64_t begin_ns) {
    WriteText(file,
              "name = \"small\"\nfps_nominal = 25\ncameras = [\"cam1\", \"cam2\", \"cam3\"]\n"
              "begin_ns = " +
                  std::to_string(begin_ns) + "\n");
  };
  begin_at(take_.TimeNs(1, 2));
  const Studio studio = OpenTake(layout_.folder, {});
  for (const StudioCamera& camera : studio.cameras) {
    Frame frame;
    camera.driver->Start();
    ASSERT_EQ(camera.driver->Grab(frame, milliseconds(0)), GrabStatus::kFrame);
    EXPECT_GE(frame.capture_ns, take_.TimeNs(1, 2));
    EXPECT_LT(frame.capture_ns, take_.TimeNs(1, 3));
  }
  begin_at(take_.TimeNs(2, take_.frames));
  EXPECT_THAT(ErrorOnOpening(), HasSubstr("cam1.csv: ends before begin_ns of take.toml"));
}

TEST_F(OpenedTake, TimesThatAreNoNanosecondsAreRefused) {
  WriteSmallTake(layout_.folder, take_);
  const std::pair<std::int64_t, const char*> cases[] = {
      {40'000, "as if in microseconds; expected"},
      {40, "as if in milliseconds; expected"},
      {40'000'000'000, "expected timestamp_ns in nanoseconds"}};
  for (const auto& [interval, says] : cases) {
    WriteText(layout_.Table("cam2"), TableWithIntervals(interval));
    EXPECT_THAT(ErrorOnOpening(),
                AllOf(HasSubstr("cam2.csv: "), HasSubstr("fps_nominal = 25"), HasSubstr(says)));
  }
}

TEST_F(OpenedTake, ADoubtfulRateAndACutOffRowAreRemarks) {
  WriteSmallTake(layout_.folder, take_);
  // Its cameras hang below the floor.
  const std::vector<std::string> before = OpenTake(layout_.folder, {}).remarks;
  EXPECT_THAT(before, ElementsAre(HasSubstr("z points down")));
  WriteText(layout_.Table("cam2"), TableWithIntervals(8'000'000));
  WriteText(layout_.Table("cam3"), TableWithIntervals(40'000'000) + "5,1");
  const Studio studio = OpenTake(layout_.folder, {});
  EXPECT_THAT(studio.remarks, ElementsAre(before[0], HasSubstr("frames are 8 ms apart"),
                                          HasSubstr("last line is cut off")));
}

struct Damage {
  const char* name;
  std::function<void(const TakeLayout&)> change;
  const char* file;  ///< That the message must name.
};

TEST_F(OpenedTake, EveryDamageIsOneLineThatNamesTheFile) {
  using std::filesystem::remove;
  const Damage cases[] = {
      {"no take.toml", [](const TakeLayout& t) { remove(t.Description()); }, "take.toml"},
      {"no calibration", [](const TakeLayout& t) { remove(t.Calibration()); }, "calibration.toml"},
      {"empty calibration", [](const TakeLayout& t) { WriteText(t.Calibration(), ""); },
       "calibration.toml:1: cameras is empty; expected [cameras.cam1] (the file is empty)"},
      {"no background", [](const TakeLayout& t) { remove_all(t.folder / "background"); },
       "take: has no pictures of the empty studio"},
      {"no background of one", [](const TakeLayout& t) { remove(t.BackgroundVideo("cam1")); },
       "background/cam1.mkv"},
      {"no table", [](const TakeLayout& t) { remove(t.Table("cam2")); }, "cam2.csv"},
      {"no video", [](const TakeLayout& t) { remove(t.Video("cam3")); }, "cam3.mkv"},
      {"video is text", [](const TakeLayout& t) { WriteText(t.Video("cam3"), "no video\n"); },
       "cam3.mkv"},
      {"video is empty", [](const TakeLayout& t) { WriteText(t.Video("cam3"), ""); }, "cam3.mkv"},
      {"background is text",
       [](const TakeLayout& t) { WriteText(t.BackgroundVideo("cam2"), "no video\n"); },
       "background/cam2.mkv"},
      {"empty table", [](const TakeLayout& t) { WriteText(t.Table("cam2"), ""); }, "cam2.csv:1"},
      {"words in table",
       [](const TakeLayout& t) { ReplaceInFile(t.Table("cam2"), "\n1,", "\nx,"); }, "cam2.csv:3"},
      {"times go back",
       [](const TakeLayout& t) {
         WriteText(t.Table("cam3"), "frame,timestamp_ns\n0,1000\n1,999\n");
       },
       "cam3.csv:3"},
      {"other size",
       [](const TakeLayout& t) { ReplaceInFile(t.Calibration(), "[68, 50]", "[50, 68]"); },
       "cam1.mkv"},
      {"camera not calibrated",
       [](const TakeLayout& t) { ReplaceInFile(t.Calibration(), "cam2", "cam7"); },
       "calibration.toml"},
      {"angles without a head",
       [](const TakeLayout& t) {
         WriteText(t.Table("cam1"), "frame,timestamp_ns,pan_rad,tilt_rad\n0,5,0.1,0\n");
       },
       "cam1.csv"},
      {"head without angles",
       [](const TakeLayout& t) {
         ReplaceInFile(t.Calibration(), "\n[cameras.cam2]",
                       "[cameras.cam1.pan_tilt]\npan_axis = [0, 0, 1]\npan_point_mm = [0, 0, 0]\n"
                       "tilt_axis = [1, 0, 0]\ntilt_point_mm = [0, 0, 0]\n[cameras.cam2]");
       },
       "cam1.csv:1"},
      {"years between cameras",
       [](const TakeLayout& t) {
         WriteText(t.Table("cam1"), "frame,timestamp_ns\n0,5\n");
         WriteText(t.Table("cam2"), "frame,timestamp_ns\n0,1000000000000000000\n");
       },
       "take"},
      {"no rate", [](const TakeLayout& t) { ReplaceInFile(t.Description(), "25.0", "0"); },
       "take.toml:2"},
      {"camera twice", [](const TakeLayout& t) { ReplaceInFile(t.Description(), "cam2", "cam1"); },
       "take.toml:3"},
      {"camera elsewhere",
       [](const TakeLayout& t) { ReplaceInFile(t.Description(), "cam2", "../take/cam2"); },
       "take.toml:3"},
      {"no cameras",
       [](const TakeLayout& t) {
         ReplaceInFile(t.Description(), "[\"cam1\", \"cam2\", \"cam3\"]", "[]");
       },
       "take.toml:3"},
      {"no take", [](const TakeLayout& t) { remove_all(t.folder); }, "take"},
  };
  const testing::TemporaryFolder whole;
  WriteSmallTake(whole.path() / "take", take_);
  for (const Damage& damage : cases) {
    std::filesystem::remove_all(layout_.folder);
    std::filesystem::copy(whole.path() / "take", layout_.folder,
                          std::filesystem::copy_options::recursive);
    damage.change(layout_);
    EXPECT_THAT(ErrorOnOpening(), AllOf(HasSubstr(folder_.path().string()), HasSubstr(damage.file),
                                        Not(HasSubstr("\n"))))
        << damage.name;
  }
}

/// Writes masks that are white where x < 7 + frame.
void WriteMasks(const std::filesystem::path& file, const SmallTake& take, int frames) {
  std::filesystem::create_directories(file.parent_path());
  testing::GrayVideo video{.width_px = take.width_px, .height_px = take.height_px};
  for (int i = 0; i < frames; ++i) video.times.push_back(i);
  video.pixel = [](int frame, int x, int) { return x < 7 + frame ? 255 : 0; };
  WriteGrayVideo(file, video);
}

class MaskedTake : public OpenedTake {
 protected:
  void SetUp() override {
    WriteSmallTake(layout_.folder, take_);
    for (int camera = 1; camera <= take_.cameras; ++camera) WriteMasks(MaskOf(camera), take_, 12);
  }
  std::filesystem::path MaskOf(int camera) const {
    return options_.masks / ("cam" + std::to_string(camera) + ".mkv");
  }

  const TakeOptions options_{.masks = folder_.path() / "masks"};
};

TEST_F(MaskedTake, GivesTheMaskOfEachFrameAndNeedsNoBackground) {
  remove_all(layout_.Background());
  const Studio studio = OpenTake(layout_.folder, options_);
  CameraDriver& driver = *studio.cameras[1].driver;
  driver.Start();
  Frame frame;
  for (int i = 0; i < take_.frames; ++i) {
    ASSERT_EQ(driver.Grab(frame, milliseconds(0)), GrabStatus::kFrame);
    EXPECT_EQ(frame.capture_ns, take_.TimeNs(1, i));
    EXPECT_EQ(frame.image(6 + i, 20).g, 255);
    EXPECT_EQ(frame.image(7 + i, 20).g, 0);
  }
  EXPECT_EQ(driver.Grab(frame, milliseconds(0)), GrabStatus::kEnd);
}

TEST_F(MaskedTake, WhatLacksIsOneLineThatNamesTheFile) {
  WriteMasks(MaskOf(2), take_, 11);
  EXPECT_THAT(ErrorOnOpening(options_),
              HasSubstr("masks/cam2.mkv: has 11 masks; expected one for each of the 12 frames of "
                        "cam2"));
  SmallTake wide = take_;
  wide.width_px = 70;
  WriteMasks(MaskOf(2), wide, 12);
  EXPECT_THAT(ErrorOnOpening(options_), HasSubstr("masks/cam2.mkv: has pictures of 70 x 50; cam2 "
                                                  "is calibrated for 68 x 50"));
  std::filesystem::remove(MaskOf(2));
  EXPECT_THAT(ErrorOnOpening(options_),
              HasSubstr("masks/cam2.mkv: not found; expected masks of cam2, one for each frame"));
  remove_all(options_.masks);
  EXPECT_THAT(ErrorOnOpening(options_),
              HasSubstr("masks: not found; expected a folder of masks, named CAMERA.mkv"));
}

TEST_F(MaskedTake, FramesThatWereCutOffNeedNoMasks) {
  testing::CutFile(layout_.Video("cam2"), 0.5);
  WriteMasks(MaskOf(2), take_, 6);
  EXPECT_EQ(CountFrames(*OpenTake(layout_.folder, options_).cameras[1].driver), 6);
}

// Recordings of other makers: H.264, MPEG-4 with B-frames, sizes that are no multiple of eight.
TEST(SharedTakes, EveryRowHasItsFrame) {
  const std::filesystem::path takes = std::filesystem::path(MOCAP_SHARED_DIR) / "takes";
  if (!std::filesystem::exists(takes)) GTEST_SKIP() << takes << " is not on this machine";
  const std::pair<const char*, int> cases[] = {{"jump_woman162", 90}, {"real_seated", 426}};
  for (const auto& [name, frames] : cases) {
    const TakeOptions options{.rate = ReplayRate::kFast, .loop = false, .cameras = {"cam2"}};
    const Studio studio = OpenTake(takes / name, options);
    EXPECT_EQ(CountFrames(*studio.cameras[0].driver), frames) << name;
  }
}

}  // namespace
}  // namespace mocap

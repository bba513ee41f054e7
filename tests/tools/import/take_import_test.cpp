// mocap take import, end to end: videos of a simulated studio, as if phones had made them.
#include "tools/take_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "config/open_studio.h"
#include "core/errors.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/take_table.h"
#include "drivers/take/video_copy.h"
#include "drivers/take/video_reader.h"
#include "drivers/take/video_writer.h"
#include "tests/support/run_command.h"
#include "tests/support/temporary_folder.h"
#include "tools/simulate.h"
#include "tools/take.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kFps = 25;
constexpr PictureTurn kRight = {0, 1, -1, 0}, kLeft = {0, -1, 1, 0};

/// A phone's part of the recording.
struct Part {
  int first = 0;  ///< Frames before the phone was started.
  int step = 1;   ///< It takes every so many of them.
  bool is_turned = false;
};

/// Writes a video as its phone would have: lying pictures with a tag, if it was held upright.
void WritePart(const fs::path& from, const fs::path& to, const Part& part) {
  VideoReader video(from);
  const fs::path lying = to.string() + ".lying.mkv";
  const int width = part.is_turned ? video.height_px() : video.width_px();
  const int height = part.is_turned ? video.width_px() : video.height_px();
  VideoWriter writer(part.is_turned ? lying : to, width, height, kFps / part.step,
                     VideoPixels::kBgr);
  Image<Bgr> turned(width, height);
  ImageView<const Bgr> picture;
  for (int i = 0; video.Read(picture) == VideoStatus::kFrame; ++i) {
    if (i < part.first || (i - part.first) % part.step != 0) continue;
    if (part.is_turned) Turn(kLeft, picture, turned.view());
    writer.Write(part.is_turned ? std::as_const(turned).view() : picture);
  }
  writer.Finish();
  if (!part.is_turned) return;
  ASSERT_TRUE(CopyVideo(lying, to, kRight));
  fs::remove(lying);
}

void SimulateTake(const fs::path& take, const std::string& options) {
  ::testing::internal::CaptureStdout();
  testing::RunCommand(AddSimulateCommand, "simulate --out " + take.string() + ' ' + options);
  ::testing::internal::GetCapturedStdout();
}

/// Four phones that were started one after the other.
class TakeImport : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new testing::TemporaryFolder;
    SimulateTake(Source(), "--width 320 --height 240 --cameras 4 --seconds 4 --fps 25");
    fs::create_directories(Videos());
    for (const auto& [camera, part] : Parts())
      WritePart(TakeLayout{Source()}.Video(camera), Videos() / (camera + ".mkv"), part);
  }
  static void TearDownTestSuite() { delete std::exchange(folder_, nullptr); }
  void SetUp() override { fs::remove_all(Out()); }

  static std::map<std::string, Part> Parts() {
    return {{"cam1", {3}}, {"cam2", {0, 2}}, {"cam3", {11, 1, true}}, {"cam4", {6}}};
  }
  static fs::path Source() { return folder_->path() / "source"; }
  static fs::path Videos() { return folder_->path() / "videos"; }
  static fs::path Out() { return folder_->path() / "out"; }
  static std::string All(const fs::path& folder) {
    std::string files;
    for (const auto& [camera, part] : Parts()) files += ' ' + (folder / (camera + ".mkv")).string();
    return files;
  }
  static std::string Calibrated() {
    return " --calibration " + TakeLayout{Source()}.Calibration().string() + " --out " +
           Out().string();
  }
  static std::string WithRoom() {
    return " --background" + All(TakeLayout{Source()}.Background()) + Calibrated();
  }

  /// What the command prints; or why it refuses.
  static std::string Import(const std::string& options) {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    std::string refusal;
    try {
      testing::RunCommand(AddTakeCommand, "take import" + options);
    } catch (const SetupError& error) {
      refusal = error.what();
    }
    ::testing::internal::GetCapturedStderr();
    const std::string said = ::testing::internal::GetCapturedStdout();
    return refusal.empty() ? said : refusal;
  }

  static nlohmann::json ImportJson(const std::string& options) {
    const std::string said = Import(options + " --json");
    const auto json = nlohmann::json::parse(said, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << said;
    return json;
  }

  /// Largest error of a frame's time, when the first frame of cam1 is right.
  static double WorstTime_s() {
    const TakeLayout out{Out()}, source{Source()};
    const auto time_of = [](const TakeLayout& take, const std::string& camera, std::size_t row) {
      return static_cast<double>(ReadTakeTable(take.Table(camera)).rows.at(row).timestamp_ns) / 1e9;
    };
    const auto first = static_cast<std::size_t>(Parts()["cam1"].first);
    const double shift_s = time_of(source, "cam1", first) - time_of(out, "cam1", 0);
    double worst_s = 0;
    for (const auto& [camera, part] : Parts()) {
      for (const int frame : {0, 10, 30}) {
        const auto row = static_cast<std::size_t>(part.first + frame * part.step);
        worst_s = std::max(worst_s, std::abs(time_of(out, camera, frame) + shift_s -
                                             time_of(source, camera, row)));
      }
    }
    return worst_s;
  }

  static testing::TemporaryFolder* folder_;
};

testing::TemporaryFolder* TakeImport::folder_ = nullptr;

TEST_F(TakeImport, SynchronizesPhonesByMotionToAQuarterOfAFrame) {
  const auto json = ImportJson(All(Videos()) + WithRoom());
  EXPECT_LT(WorstTime_s(), 0.25 / kFps);
  for (const auto& camera : json["cameras"]) {
    EXPECT_EQ(camera["method"], "motion");
    EXPECT_GT(camera["confidence"], 0.2);
    EXPECT_EQ(camera["background"]["source"], "clip");
    EXPECT_TRUE(camera["light"]["exposure_fixed"]);
    EXPECT_EQ(camera["variable_rate"], false);
  }
  EXPECT_NEAR(json["cameras"][0]["rate_hz"].get<double>(), kFps, 0.05);
  EXPECT_NEAR(json["cameras"][1]["rate_hz"].get<double>(), kFps / 2, 0.05);
  EXPECT_EQ(json["cameras"][2]["turned"], "turned right by 90 degrees");
  EXPECT_NEAR(json["common_s"].get<double>(), 88 / kFps, 2 / kFps);
}

TEST_F(TakeImport, KeepsThePictures) {
  ImportJson(All(Videos()) + WithRoom() + " --offsets cam1=0,cam2=0,cam3=0,cam4=0");
  for (const auto& [camera, part] : Parts()) {
    VideoReader video(TakeLayout{Out()}.Video(camera));
    VideoReader source(TakeLayout{Source()}.Video(camera));
    for (int i = 0; i < part.first; ++i) source.Skip();
    ImageView<const Bgr> picture, wanted;
    ASSERT_EQ(video.Read(picture), VideoStatus::kFrame);
    ASSERT_EQ(source.Read(wanted), VideoStatus::kFrame);
    ASSERT_EQ(picture.width(), wanted.width());
    for (int y = 0; y < picture.height(); y += 7)
      for (int x = 0; x < picture.width(); x += 7) ASSERT_EQ(picture(x, y), wanted(x, y)) << camera;
  }
}

TEST_F(TakeImport, UsesGivenOffsets) {
  const auto json =
      ImportJson(All(Videos()) + WithRoom() + " --offsets cam1=0.12,cam2=0,cam3=0.44,cam4=0.24");
  EXPECT_LT(WorstTime_s(), 0.0015);
  EXPECT_EQ(json["cameras"][2]["method"], "given");
  EXPECT_NEAR(json["cameras"][2]["offset_s"].get<double>(), 0.32, 1e-6);
}

TEST_F(TakeImport, FindsByMotionWhatIsNotGiven) {
  const auto json =
      ImportJson(All(Videos()) + WithRoom() + " --offsets cam1=0.12,cam2=0,cam3=0.44");
  EXPECT_LT(WorstTime_s(), 0.25 / kFps);
  EXPECT_EQ(json["cameras"][0]["method"], "given");
  EXPECT_EQ(json["cameras"][3]["method"], "motion");
}

TEST_F(TakeImport, MakesATakeThatOpens) {
  EXPECT_THAT(Import(All(Videos()) + WithRoom()), HasSubstr("written: " + Out().string()));
  const Studio studio = OpenTake(Out(), {});
  EXPECT_EQ(studio.cameras.size(), 4u);
  EXPECT_EQ(studio.fps_nominal, kFps);
  // It begins when all cameras film. The slowest has half of the rate.
  std::vector<std::int64_t> firsts_ns;
  for (const StudioCamera& camera : studio.cameras) {
    Frame frame;
    camera.driver->Start();
    ASSERT_EQ(camera.driver->Grab(frame, std::chrono::milliseconds(0)), GrabStatus::kFrame);
    firsts_ns.push_back(frame.capture_ns);
  }
  const auto [first, last] = std::ranges::minmax(firsts_ns);
  EXPECT_LE(static_cast<double>(last - first), 2e9 / kFps);
  EXPECT_FALSE(fs::exists(Out().string() + ".partial"));
}

TEST_F(TakeImport, TellsWhatIsWrongWithEachCamera) {
  const std::string refusal =
      Import(" cam1=" + (Videos() / "cam3.mkv").string() + ' ' + (Videos() / "cam2.mkv").string() +
             " cam3=" + (folder_->path() / "none.mp4").string() + Calibrated());
  EXPECT_THAT(refusal, HasSubstr("cam3: "));
  EXPECT_THAT(refusal, HasSubstr("none.mp4"));
  EXPECT_FALSE(fs::exists(Out()));
  EXPECT_FALSE(fs::exists(Out().string() + ".partial"));
}

TEST_F(TakeImport, RefusesAnotherSize) {
  const fs::path small = folder_->path() / "cam1.mkv";
  VideoWriter writer(small, 64, 48, kFps, VideoPixels::kBgr);
  const Image<Bgr> black(64, 48);
  for (int i = 0; i < 20; ++i) writer.Write(black.view());
  writer.Finish();
  EXPECT_THAT(Import(' ' + small.string() + ' ' + (Videos() / "cam2.mkv").string() + Calibrated()),
              AllOf(HasSubstr("cam1"), HasSubstr("64x48"), HasSubstr("320x240")));
}

TEST_F(TakeImport, RefusesOffsetsWithoutACommonTime) {
  EXPECT_THAT(Import(All(Videos()) + WithRoom() + " --offsets cam1=0,cam2=0,cam3=90,cam4=0"),
              AllOf(HasSubstr("cam3"), HasSubstr("expected videos of the same time")));
  EXPECT_FALSE(fs::exists(Out().string() + ".partial"));
}

TEST_F(TakeImport, RefusesMethodsThatTheFilesDoNotHave) {
  EXPECT_THAT(Import(All(Videos()) + WithRoom() + " --sync sound"), HasSubstr("no sound"));
  EXPECT_THAT(Import(All(Videos()) + WithRoom() + " --sync timecode"), HasSubstr("no timecode"));
  EXPECT_THAT(Import(All(Videos()) + WithRoom() + " --sync given"), HasSubstr("cam1"));
}

TEST_F(TakeImport, RefusesAClipWithPeopleAsTheEmptyRoom) {
  EXPECT_THAT(Import(All(Videos()) + " --background" + All(Videos()) + Calibrated() +
                     " --offsets cam1=0,cam2=0,cam3=0,cam4=0"),
              HasSubstr("expected a clip without people"));
}

TEST(TakeImportOfWalkers, FindsTheEmptyRoomBehindThem) {
  const testing::TemporaryFolder folder;
  const fs::path source = folder.path() / "source", out = folder.path() / "out";
  SimulateTake(source, "--width 160 --height 120 --cameras 2 --people 2 --seconds 50 --fps 2");
  const TakeLayout layout{source};
  ::testing::internal::CaptureStdout();
  testing::RunCommand(AddTakeCommand, "take import " + layout.Video("cam1").string() + ' ' +
                                          layout.Video("cam2").string() + " --calibration " +
                                          layout.Calibration().string() +
                                          " --offsets cam1=0,cam2=0 --json --out " + out.string());
  const auto json = nlohmann::json::parse(::testing::internal::GetCapturedStdout());
  for (const auto& camera : json["cameras"]) {
    EXPECT_EQ(camera["background"]["source"], "itself");
    EXPECT_LT(camera["background"]["unseen"], 0.1);
  }
}

}  // namespace
}  // namespace mocap

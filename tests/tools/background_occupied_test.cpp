#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "config/camera_files.h"
#include "config/load_config.h"
#include "core/errors.h"
#include "daemon/service/occupied_room.h"
#include "drivers/take/mask_video.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/video_reader.h"
#include "drivers/take/video_writer.h"
#include "tests/support/run_command.h"
#include "tests/support/temporary_folder.h"
#include "tools/background.h"
#include "tools/evaluate.h"
#include "tools/simulate.h"
#include "tools/track.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

void Simulate(const fs::path& take, const std::string& options,
              const std::string& studio = "--width 160 --height 120 --cameras 3") {
  ::testing::internal::CaptureStdout();
  testing::RunCommand(AddSimulateCommand,
                      "simulate --out " + take.string() + ' ' + studio + ' ' + options);
  ::testing::internal::GetCapturedStdout();
}

/// Two people walk about for a minute.
class WalkedStudio : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new testing::TemporaryFolder;
    Simulate(Minute(), "--people 2 --seconds 60 --fps 2");
  }
  static void TearDownTestSuite() { delete std::exchange(folder_, nullptr); }

  void SetUp() override {
    fs::remove_all(take_.folder);
    fs::copy(Minute(), take_.folder, fs::copy_options::recursive);
  }

  static fs::path Minute() { return folder_->path() / "minute"; }
  /// Why learning failed; empty: it did not.
  static std::string Refusal(const std::string& options) {
    try {
      testing::RunCommand(AddBackgroundCommand, "background learn --occupied " + options);
    } catch (const SetupError& error) {
      return error.what();
    }
    return "";
  }
  std::string Learn(const std::string& options = "") const {
    ::testing::internal::CaptureStdout();
    const std::string refusal = Refusal("--take " + take_.folder.string() + options);
    const std::string said = ::testing::internal::GetCapturedStdout();
    return refusal.empty() ? said : refusal;
  }
  static std::vector<BackgroundFrame> Background(const TakeLayout& take, const std::string& name) {
    for (const CameraCalibration& camera : LoadCalibration(take.Calibration())) {
      if (camera.name == name)
        return OpenCameraBackground(take.BackgroundVideo(name), take.BackgroundTable(name),
                                    camera)();
    }
    return {};
  }
  /// The mean green of a pixel.
  static double GreenAt(const std::vector<BackgroundFrame>& frames, int x, int y) {
    double sum = 0;
    for (const BackgroundFrame& frame : frames) sum += frame.image(x, y).g;
    return sum / static_cast<double>(frames.size());
  }
  /// Changes the stored background of cam2. @param right  the last column that is changed.
  void Store(int right, int top, const std::function<Bgr(const Bgr&)>& change) const {
    const std::vector<BackgroundFrame> frames = Background(take_, "cam2");
    VideoWriter video(take_.BackgroundVideo("cam2"), 160, 120, 10, VideoPixels::kBgr);
    for (BackgroundFrame frame : frames) {
      for (int y = top; y < 110; ++y) {
        for (int x = 10; x <= right; ++x) frame.image(x, y) = change(frame.image(x, y));
      }
      video.Write(frame.image.view());
    }
    video.Finish();
  }
  void StoreBox() const {
    Store(33, 80, [](const Bgr&) { return Bgr{220, 20, 220}; });
  }

  static inline testing::TemporaryFolder* folder_ = nullptr;
  const TakeLayout take_{folder_->path() / "take"};
};

TEST_F(WalkedStudio, GetsTheBackgroundThatItHasWhenItIsEmpty) {
  fs::remove_all(take_.Background());
  EXPECT_THAT(Learn(), ContainsRegex("cam1: 120 pictures, 0[0-9.]* % of its picture was never"));
  for (const char* camera : {"cam1", "cam2", "cam3"}) {
    const std::vector<BackgroundFrame> learned = Background(take_, camera);
    const std::vector<BackgroundFrame> empty = Background(TakeLayout{Minute()}, camera);
    ASSERT_EQ(learned.size(), 50u);
    int wrong = 0;
    double sum = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        const double off = std::abs(GreenAt(learned, x, y) - GreenAt(empty, x, y));
        sum += off;
        wrong += off > 5;
      }
    }
    EXPECT_LT(sum / (160 * 120), 1) << camera;
    EXPECT_LT(wrong, 160 * 120 / 100) << camera;
  }
}

TEST_F(WalkedStudio, WhatWasMovedIsNamedAndStaysAsItWasStored) {
  StoreBox();
  EXPECT_THAT(Learn(), AllOf(HasSubstr("cam2: something was moved at the bottom left, x 8 to 39, y "
                                       "80 to 111 px ("),
                             HasSubstr(" % of the picture); the stored background remains there, "
                                       "unless you use --accept cam2\n"),
                             Not(HasSubstr("cam1: something")), Not(HasSubstr("cam3: something"))));
  EXPECT_NEAR(GreenAt(Background(take_, "cam2"), 20, 95), 20, 3);
}

TEST_F(WalkedStudio, WhatWasMovedIsLearnedOnRequest) {
  StoreBox();
  EXPECT_THAT(Learn(" --accept cam2,cam3"),
              ContainsRegex("cam2: something was moved at the bottom left,.*; it is part of the "
                            "background now"));
  EXPECT_NEAR(GreenAt(Background(take_, "cam2"), 20, 95),
              GreenAt(Background(TakeLayout{Minute()}, "cam2"), 20, 95), 5);
}

TEST_F(WalkedStudio, AnotherViewIsRefusedUnlessItIsAccepted) {
  Store(159, 0, [](const Bgr& color) {
    return color.g > 127 ? Bgr{20, 20, 90} : Bgr{200, 240, 200};
  });
  EXPECT_THAT(Learn(), ContainsRegex("cam2: [0-9]+ % of its picture differs from the stored "
                                     "background; .* --accept cam2"));
  EXPECT_FALSE(fs::exists(take_.Background().string() + ".partial"));
  Learn(" --accept cam2");
  EXPECT_NEAR(GreenAt(Background(take_, "cam2"), 20, 95),
              GreenAt(Background(TakeLayout{Minute()}, "cam2"), 20, 95), 5);
}

TEST_F(WalkedStudio, SomebodyWhoSitsThereAllTheTimeIsNotLearnedBeforeAStoredBackground) {
  fs::remove_all(take_.folder);
  Simulate(take_.folder, "--people 2 --motion sit --seconds 60 --fps 1");
  const std::vector<BackgroundFrame> empty = Background(take_, "cam1");
  EXPECT_THAT(Learn(), HasSubstr("cam1: something was moved at the "));
  const std::vector<BackgroundFrame> learned = Background(take_, "cam1");
  int wrong = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x)
      wrong += std::abs(GreenAt(learned, x, y) - GreenAt(empty, x, y)) > 8;
  }
  EXPECT_LT(wrong, 160 * 120 / 1000);
}

TEST_F(WalkedStudio, ATakeGivesTheBackgroundOfItsStudio) {
  const fs::path file = folder_->path() / "studio.toml";
  const auto configure = [&](const std::string& cameras) {
    testing::WriteText(file,
                       "calibration = \"take/calibration.toml\"\nbackground = \"empty\"\n[source]\n"
                       "driver = \"v4l2\"\n" +
                           cameras);
  };
  const auto camera = [](const std::string& name) {
    return "[[cameras]]\nname = \"" + name + "\"\ndevice = \"/dev/" + name + "\"\n";
  };
  configure(camera("cam1") + camera("cam3"));
  const std::string before = testing::ReadText(take_.BackgroundVideo("cam1"));
  EXPECT_THAT(Learn(" --config " + file.string()),
              AllOf(HasSubstr("cam1: 120 pictures"), HasSubstr("cam3: 120 pictures"),
                    Not(HasSubstr("cam2"))));
  EXPECT_TRUE(fs::exists(folder_->path() / "empty/cam1.mkv"));
  EXPECT_FALSE(fs::exists(folder_->path() / "empty/cam2.mkv"));
  EXPECT_EQ(testing::ReadText(take_.BackgroundVideo("cam1")), before);
  configure(camera("cam1") + camera("cam7"));
  EXPECT_THAT(Learn(" --config " + file.string()), HasSubstr("take: has no camera \"cam7\" of "));
  testing::WriteText(file, "[source]\ndriver = \"simulated\"\n");
  EXPECT_THAT(Learn(" --config " + file.string()),
              HasSubstr("studio.toml: source.driver is \"simulated\""));
}

TEST(OccupiedRecord, NamesTheLargestThingsAndCountsTheOthers) {
  OccupiedRecord record{.camera = "cam1", .width_px = 100, .height_px = 100, .pictures = 60};
  for (int i = 0; i < 5; ++i) record.moved.push_back({{0, 0, 9, 9}, 90 - i});
  const std::vector<std::string> lines = TextOf(record);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "cam1: 60 pictures, 0 % of its picture was never seen without people");
  EXPECT_THAT(lines[1], HasSubstr("at the top left, x 0 to 9, y 0 to 9 px (0.9 % of the picture)"));
  EXPECT_EQ(lines[4], "cam1: likewise at 2 smaller places");
}

/// Somebody in a striped shirt stands before the wall of a camera all the time, swaying.
Bgr StripedAt(int picture, int x, int y, const Bgr& wall) {
  const int right = picture * 7 % 5, down = picture / 5 * 2 % 5;
  if (x < 30 + right || x >= 70 + right || y < 60 + down || y >= 186 + down) return wall;
  return (y - down) / 20 % 2 == 0 ? Bgr{190, 60, 40} : Bgr{40, 170, 190};
}

/// A place that changes all the time.
Bgr BusyAt(int picture, int x, int y, const Bgr& wall) {
  const auto grey = static_cast<std::uint8_t>(picture * 67 % 250);
  return x >= 10 && x < 34 && y >= 80 && y < 110 ? Bgr{grey, 128, grey} : wall;
}

/// Paints each pixel of a video, in each of its pictures.
void Repaint(const fs::path& file, Bgr (*paint)(int picture, int x, int y, const Bgr& wall)) {
  const fs::path painted = file.string() + ".painted.mkv";
  {
    VideoReader from(file);
    VideoWriter to(painted, from.width_px(), from.height_px(), 1, VideoPixels::kBgr);
    ImageView<const Bgr> view;
    for (int i = 0; from.Read(view) == VideoStatus::kFrame; ++i) {
      Image<Bgr> image(view.width(), view.height());
      for (int y = 0; y < view.height(); ++y)
        for (int x = 0; x < view.width(); ++x) image(x, y) = paint(i, x, y, view(x, y));
      to.Write(image.view());
    }
    to.Finish();
  }
  fs::rename(painted, file);
}

/// The mean error of two people's tracking [mm], and how many frames somebody was tracked in.
std::pair<double, int> TrackedWithin(const fs::path& take) {
  const auto number_in = [](const std::string& command, const std::string& key, auto add) {
    ::testing::internal::CaptureStdout();
    testing::RunCommand(add, command);
    const std::string said = ::testing::internal::GetCapturedStdout();
    const std::size_t at = said.find('"' + key + "\":");
    return at == std::string::npos ? -1 : std::stod(said.substr(at + key.size() + 3));
  };
  const std::string result = take.string() + "-result";
  const double tracked = number_in("track " + take.string() + " --people 2 --json --out " + result,
                                   "tracked_frames", AddTrackCommand);
  const double error_mm = number_in("evaluate " + take.string() + ' ' + result + "/person-1 --json",
                                    "mpjpe_mm", AddEvaluateCommand);
  return {error_mm, static_cast<int>(tracked)};
}

TEST(StayedStudio, SomebodyWhoStoodBeforeAWallAllTheTimeIsUnknownAndTrackingIsNoWorse) {
  const testing::TemporaryFolder folder;
  const TakeLayout minute{folder.path() / "minute"}, walk{folder.path() / "walk"};
  const std::string studio = "--width 320 --height 240 --cameras 5 --seed 4";
  Simulate(minute.folder, "--people 2 --seconds 40 --fps 1", studio);
  Simulate(walk.folder, "--seconds 1.5 --fps 20", studio);
  const auto [error_mm, tracked] = TrackedWithin(walk.folder);
  fs::remove_all(minute.Background());
  Repaint(minute.Video("cam1"), StripedAt);
  ::testing::internal::CaptureStdout();
  testing::RunCommand(AddBackgroundCommand,
                      "background learn --occupied --take " + minute.folder.string());
  EXPECT_THAT(::testing::internal::GetCapturedStdout(),
              ContainsRegex("cam1: 40 pictures, [0-9.]+ % of its picture was never seen without "
                            "people; it is unknown\n"));
  const Silhouette unseen = ReadMask(minute.BackgroundUnseen("cam1"));
  for (int y = 62; y < 188; ++y)
    for (int x = 36; x < 68; ++x) ASSERT_TRUE(unseen.Test(x, y)) << x << " " << y;
  EXPECT_LT(unseen.CoveredShare(), 0.1);
  fs::remove_all(walk.Background());
  fs::copy(minute.Background(), walk.Background(), fs::copy_options::recursive);
  const auto [learned_mm, learned_tracked] = TrackedWithin(walk.folder);
  EXPECT_GE(learned_tracked, tracked - 1);
  EXPECT_LT(learned_mm, 1.1 * error_mm);
}

TEST_F(WalkedStudio, WhatWasUnknownIsLearnedOnceItIsSeen) {
  fs::remove_all(take_.Background());
  const fs::path seen = folder_->path() / "seen.mkv";
  fs::copy(take_.Video("cam2"), seen);
  Repaint(take_.Video("cam2"), BusyAt);
  Learn();
  EXPECT_TRUE(ReadMask(take_.BackgroundUnseen("cam2")).Test(20, 95));
  fs::copy(seen, take_.Video("cam2"), fs::copy_options::overwrite_existing);
  EXPECT_THAT(Learn(), Not(HasSubstr("cam2: something was moved")));
  EXPECT_FALSE(fs::exists(take_.BackgroundUnseen("cam2")) &&
               ReadMask(take_.BackgroundUnseen("cam2")).Test(20, 95));
  EXPECT_NEAR(GreenAt(Background(take_, "cam2"), 20, 95),
              GreenAt(Background(TakeLayout{Minute()}, "cam2"), 20, 95), 5);
}

TEST_F(WalkedStudio, WhatCannotBeLearnedIsOneLine) {
  const fs::path still = folder_->path() / "still", turned = folder_->path() / "turned";
  EXPECT_THAT(Refusal("--accept cam9 --take " + take_.folder.string()),
              HasSubstr("--accept: there is no camera \"cam9\""));
  Simulate(still, "--people 2 --motion sit --seconds 60 --fps 1");
  fs::remove_all(still / "background");
  {
    VideoWriter busy(still / "cam1.mkv", 160, 120, 1, VideoPixels::kBgr);
    for (int i = 0; i < 60; ++i) {
      Image<Bgr> image(160, 120);
      for (std::size_t k = 0; k < image.pixels().size(); ++k)
        image.pixels()[k] =
            k % 4 == 0 ? Bgr{static_cast<std::uint8_t>(i * 67), 90, 30} : Bgr{90, 100, 110};
      busy.Write(image.view());
    }
    busy.Finish();
  }
  EXPECT_THAT(Refusal("--take " + still.string()),
              ContainsRegex("cam1: [0-9.]+ % of its picture was never seen without people"));
  Simulate(turned, "--seconds 2 --fps 4 --pan-tilt");
  EXPECT_THAT(Refusal("--take " + turned.string()), HasSubstr("is on a pan-tilt head"));
  Simulate(folder_->path() / "short", "--seconds 4 --fps 10");
  EXPECT_THAT(Refusal("--take " + (folder_->path() / "short").string()),
              HasSubstr("cam1: has only 8 pictures at 2 a second; expected at least 30"));
}

}  // namespace
}  // namespace mocap

#include "tools/track.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "config/load_config.h"
#include "drivers/clock.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/text_file.h"
#include "tests/support/gray_video.h"
#include "tests/support/run_command.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/calibrate.h"
#include "tools/results/result.h"
#include "tools/simulate.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// What a command says and how it fails, in one text.
std::string Said(void (*add)(CLI::App&), const std::string& command_line) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  std::string failure;
  try {
    testing::RunCommand(add, command_line);
  } catch (const std::exception& error) {
    failure = error.what();
  }
  const std::string out = ::testing::internal::GetCapturedStdout();
  return out + ::testing::internal::GetCapturedStderr() + failure;
}

/// A walk before four cameras, and changes of its calibration.
class WalkTracked : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new testing::TemporaryFolder;
    Said(AddSimulateCommand,
         "simulate --seconds 4 --fps 4 --cameras 4 --width 320 --height 240 "
         "--motion walk --out " +
             Take().string());
    right_ = LoadCalibration(Take() / "calibration.toml");
  }
  static void TearDownTestSuite() { delete std::exchange(folder_, nullptr); }
  void TearDown() override { Calibrate(right_); }

  static fs::path Take() { return folder_->path() / "walk"; }
  static fs::path Result() { return folder_->path() / "result"; }
  static void Calibrate(const std::vector<CameraCalibration>& cameras,
                        const fs::path& file = Take() / "calibration.toml") {
    WriteCalibration(file, cameras, {});
  }
  static std::string Track() {
    return Said(AddTrackCommand,
                "track --voxel-size 40 --out " + Result().string() + " " + Take().string());
  }
  static std::vector<CameraCalibration> UpsideDown() {
    std::vector<CameraCalibration> cameras = right_;
    for (CameraCalibration& camera : cameras) camera.X_CW.R.rightCols<2>() *= -1;
    return cameras;
  }
  static std::vector<CameraCalibration> Exchanged() {
    std::vector<CameraCalibration> cameras = right_;
    std::swap(cameras[0].X_CW, cameras[2].X_CW);
    std::swap(cameras[0].lens, cameras[2].lens);
    return cameras;
  }

  static inline testing::TemporaryFolder* folder_ = nullptr;
  static inline std::vector<CameraCalibration> right_;
};

TEST_F(WalkTracked, NothingIsSaidOfARightCalibration) {
  EXPECT_THAT(Track(), AllOf(HasSubstr("16 frame sets, "), Not(HasSubstr("mocap track:"))));
}

TEST_F(WalkTracked, AWrongCalibrationIsToldAndReplacesNoResult) {
  Track();
  const std::string before = testing::ReadText(Result() / "poses.csv");
  Calibrate(UpsideDown());
  EXPECT_THAT(Track(), AllOf(HasSubstr("all cameras hang below the floor"),
                             HasSubstr("nobody was tracked: "), HasSubstr("z points down")));
  EXPECT_EQ(testing::ReadText(Result() / "poses.csv"), before);
  const fs::path none = folder_->path() / "none";
  Said(AddTrackCommand, "track --voxel-size 40 --out " + none.string() + " " + Take().string());
  EXPECT_FALSE(fs::exists(none));
}

TEST_F(WalkTracked, WhatIsRemovedOfAnEarlierResultIsTold) {
  Track();
  const std::string people =
      "track --voxel-size 40 --people 2 --out " + Result().string() + " " + Take().string();
  EXPECT_THAT(Said(AddTrackCommand, people),
              HasSubstr("replaces an earlier result; removed its poses.csv\n"));
  fs::copy(Result() / "person-1", Result() / "person-7");
  EXPECT_THAT(Said(AddTrackCommand, people), HasSubstr("removed its person-7\n"));
  EXPECT_THAT(Track(), HasSubstr("removed its person-1\n"));
  EXPECT_THAT(Track(), Not(HasSubstr("removed")));
}

TEST_F(WalkTracked, AnEmptyRoomReplacesNoResult) {
  Track();
  const std::string before = testing::ReadText(Result() / "poses.csv");
  const fs::path empty = folder_->path() / "empty";
  Said(AddSimulateCommand,
       "simulate --seconds 1 --fps 4 --cameras 4 --width 320 --height 240 --motion visit --out " +
           empty.string());
  const std::string track = "track --voxel-size 40 " + empty.string() + " --out ";
  EXPECT_THAT(Said(AddTrackCommand, track + Result().string()),
              AllOf(HasSubstr("nobody was tracked: "), HasSubstr("is kept")));
  EXPECT_EQ(testing::ReadText(Result() / "poses.csv"), before);
  EXPECT_THAT(Said(AddTrackCommand, track + (folder_->path() / "new").string()),
              HasSubstr("4 frame sets, 0 tracked"));
}

TEST_F(WalkTracked, SilhouettesAreTheGivenMasks) {
  const fs::path masked = folder_->path() / "masked", dark = folder_->path() / "dark";
  fs::copy(Take(), masked, fs::copy_options::recursive);
  fs::remove_all(masked / "background");
  const std::string track =
      "track --voxel-size 40 " + masked.string() + " --out " + (masked / "result").string();
  EXPECT_THAT(Said(AddTrackCommand, track + " --masks"), HasSubstr("16 frame sets, 15 tracked"));
  for (const fs::path& file : fs::directory_iterator(masked / "silhouette")) {
    testing::GrayVideo black{.width_px = 320, .height_px = 240};
    for (int i = 0; i < 16; ++i) black.times.push_back(i);
    black.pixel = [](int, int, int) { return 0; };
    fs::create_directory(dark);
    WriteGrayVideo(dark / file.filename(), black);
  }
  fs::remove_all(masked / "result");
  EXPECT_THAT(Said(AddTrackCommand, track + " --masks " + dark.string()),
              HasSubstr("16 frame sets, 0 tracked"));
}

TEST_F(WalkTracked, CheckFailsIfTheCalibrationShouldNotBeUsed) {
  const fs::path other = folder_->path() / "moved.toml", here = Take() / "calibration.toml";
  const auto check = [&](double away_mm) {
    std::vector<CameraCalibration> moved = right_;
    for (CameraCalibration& camera : moved)
      camera.X_CW = camera.X_CW * RigidTransform{Matrix3::Identity(), {away_mm, 0, 0}};
    Calibrate(moved, other);
    return Said(AddCalibrateCommand,
                "calibrate check " + other.string() + " --against " + here.string());
  };
  EXPECT_THAT(check(30), AllOf(HasSubstr("note: points in the room lie 30.0 mm from"),
                               HasSubstr("0.0 mm remain if the world frame is moved by 30.0 mm"),
                               HasSubstr("is good"), Not(HasSubstr("error"))));
  EXPECT_THAT(check(1500), AllOf(HasSubstr("error: points in the room lie 1500.0 mm from"),
                                 HasSubstr("Do not use this calibration."),
                                 HasSubstr("moved.toml: has 1 error, see above")));
}

TEST_F(WalkTracked, ACalibrationThatShouldNotBeUsedReplacesNone) {
  const fs::path points = folder_->path() / "points.csv", out = folder_->path() / "floor.toml";
  std::string rows;
  for (const auto& [name, p_W] :
       {std::pair("origin", Vector3(0, 0, 0)), std::pair("x", Vector3(500, 0, 0)),
        std::pair("y", Vector3(0, 500, 0))}) {
    for (const CameraCalibration& camera : right_) {
      const Vector3 p_C = camera.X_CW * p_W;
      const Vector2 pixel = *PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
      rows += fmt::format("{},{},{},{}\n", name, camera.name, pixel.x(), pixel.y());
    }
  }
  testing::WriteText(points, rows);
  testing::WriteText(out, "# the calibration in use\n");
  EXPECT_THAT(
      Said(AddCalibrateCommand, "calibrate floor " + (Take() / "calibration.toml").string() +
                                    " --distance cam1:cam2:100 --floor-points " + points.string() +
                                    " --out " + out.string()),
      AllOf(HasSubstr("Do not use this calibration."),
            HasSubstr("floor.toml.rejected: has 1 error, see above")));
  EXPECT_EQ(testing::ReadText(out), "# the calibration in use\n");
  EXPECT_TRUE(fs::exists(out.string() + ".rejected"));
}

TEST_F(WalkTracked, CheckSaysTheTapesDistanceOnce) {
  const std::string said = Said(AddCalibrateCommand, "calibrate check --distance cam1:cam2:100 " +
                                                         (Take() / "calibration.toml").string());
  EXPECT_THAT(said, HasSubstr("100 mm by the tape"));
  EXPECT_EQ(said.find("by the tape"), said.rfind("by the tape"));
  EXPECT_THAT(said, HasSubstr("has 1 error"));
}

TEST_F(WalkTracked, CheckShowsWhatHealthNoted) {
  const std::string file = (Take() / "calibration.toml").string();
  EXPECT_THAT(Said(AddCalibrateCommand, "calibrate check " + file),
              HasSubstr("health not checked yet"));
  CalibrationRecord record;
  record.made_s = record.checked_s = TimeOfDayS();
  record.offsets = {{"cam1", 0.25, false}, {"cam2", 0.75, false}};
  WriteCalibration(file, right_, record);
  EXPECT_THAT(
      Said(AddCalibrateCommand, "calibrate check " + file),
      HasSubstr("made today; health checked today, no camera has moved (at most 0.8 px, cam2)"));
  record.offsets[1] = {"cam2", 12.25, true};
  WriteCalibration(file, right_, record);
  EXPECT_THAT(Said(AddCalibrateCommand, "calibrate check " + file),
              AllOf(HasSubstr("health checked today\n"),
                    HasSubstr("warning: cam2: had moved or was zoomed, by 12.2 px"),
                    Not(HasSubstr("is good"))));
}

TEST_F(WalkTracked, ACameraThatMovedIsToldByHealthAndCheck) {
  std::vector<CameraCalibration> bumped = right_;
  const Matrix3 turn = ExpRotation({0.02, 0, 0});
  bumped[2].X_CW = {turn * bumped[2].X_CW.R, turn * bumped[2].X_CW.p};
  const fs::path file = folder_->path() / "bumped.toml";
  Calibrate(bumped, file);
  const std::string moved = "cam3: has moved since it was calibrated, by ";
  EXPECT_THAT(
      Said(AddCalibrateCommand, "calibrate check --take " + Take().string() + " " + file.string()),
      AllOf(HasSubstr("warning: " + Take().string() + ": " + moved),
            HasSubstr("but check the warnings"), Not(HasSubstr("is good"))));
  Calibrate(bumped);
  EXPECT_THAT(
      Said(AddCalibrateCommand, "calibrate health " + Take().string()),
      AllOf(HasSubstr(moved), HasSubstr(Take().string() + ": not all cameras are as calibrated")));
}

TEST_F(WalkTracked, ATakeOfNobodySaysNothingOfCameras) {
  const std::string empty = (folder_->path() / "nobody").string();
  Said(AddSimulateCommand,
       "simulate --seconds 1 --fps 4 --cameras 4 --width 320 --height 240 --motion visit --out " +
           empty);
  const std::string file = (Take() / "calibration.toml").string();
  for (const std::string& command : {"check " + file + " --take ", std::string("health "),
                                     "refine --out " + file + ".refined "}) {
    EXPECT_THAT(testing::SetupErrorOf([&] {
                  testing::RunCommand(AddCalibrateCommand, "calibrate " + command + empty);
                }),
                HasSubstr(empty + ": "))
        << command;
  }
}

TEST_F(WalkTracked, RefiningCamerasThatHaveNotMovedSaysSoOnce) {
  const fs::path own = Take() / "calibration.toml", other = folder_->path() / "refined.toml";
  const std::string said =
      Said(AddCalibrateCommand, "calibrate refine " + Take().string() + " --out " + own.string());
  EXPECT_THAT(
      said, AllOf(HasSubstr("no camera has moved\nwritten: " + own.string() + ", the take's own\n"),
                  Not(HasSubstr("after:")), Not(HasSubstr("-0.0"))));
  EXPECT_THAT(
      Said(AddCalibrateCommand, "calibrate refine " + Take().string() + " --out " + other.string()),
      HasSubstr("written: " + other.string() + "\n"));
}

TEST_F(WalkTracked, CamerasThatGoByEachOthersNameAreTold) {
  Calibrate(Exchanged());
  EXPECT_THAT(Track(), HasSubstr("cam1 and cam3 have each other's name"));
}

TEST_F(WalkTracked, SetsBeforeTheFirstAreLeftOutAndNumbersStay) {
  Track();
  const std::vector<PoseRow> all = ReadResult(Result()).poses;
  const fs::path later = folder_->path() / "later";
  const std::string track =
      "track --voxel-size 40 --first 5 " + Take().string() + " --out " + later.string();
  for (const std::string& options : std::vector<std::string>{"", " --people 2", " --masks"}) {
    EXPECT_THAT(Said(AddTrackCommand, track + options), HasSubstr("11 frame sets, ")) << options;
    const fs::path folder = options == " --people 2" ? later / "person-1" : later;
    const std::vector<PoseRow> poses = ReadResult(folder).poses;
    // The rows of somebody among several begin when that person is found.
    ASSERT_FALSE(poses.empty());
    EXPECT_GE(poses.front().frame, 5) << options;
    EXPECT_EQ(poses.back().frame, all.back().frame) << options;
    EXPECT_EQ(poses.back().timestamp_ns, all.back().timestamp_ns) << options;
  }
}

TEST_F(WalkTracked, AFirstSetThatTheTakeDoesNotHaveIsRefused) {
  EXPECT_THAT(testing::SetupErrorOf([] {
                testing::RunCommand(AddTrackCommand, "track --first 16 --out " +
                                                         (folder_->path() / "none").string() + " " +
                                                         Take().string());
              }),
              HasSubstr("has 16 frame sets, and --first is 16; expected at most 15"));
  EXPECT_FALSE(fs::exists(folder_->path() / "none"));
}

TEST_F(WalkTracked, OneCameraIsRefusedWithAReason) {
  EXPECT_THAT(testing::SetupErrorOf([] {
                testing::RunCommand(AddTrackCommand, "track --cameras cam2 --out " +
                                                         Result().string() + " " + Take().string());
              }),
              HasSubstr("--cameras: names only cam2; expected at least two cameras"));
}

TEST_F(WalkTracked, CheckLooksAtTheTakeWithTheGivenCalibration) {
  const fs::path file = folder_->path() / "other.toml";
  const std::string check = "calibrate check --take " + Take().string() + " " + file.string();
  Calibrate(right_, file);
  EXPECT_THAT(Said(AddCalibrateCommand, check),
              AllOf(HasSubstr("This calibration is good."),
                    ::testing::ContainsRegex("cam[1-4] and cam[1-4] agree least on where people "
                                             "are: by [0-9]+ %")));
  Calibrate(Exchanged(), file);
  EXPECT_THAT(Said(AddCalibrateCommand, check), HasSubstr("cam1 and cam3 have each other's name"));
  std::vector<CameraCalibration> halved = right_;
  for (CameraCalibration& camera : halved) camera.X_CW.p /= 2;
  Calibrate(halved, file);
  EXPECT_THAT(Said(AddCalibrateCommand, check),
              AllOf(HasSubstr("a person is 8"), HasSubstr("tall")));
  halved.pop_back();
  Calibrate(halved, file);
  EXPECT_THAT(Said(AddCalibrateCommand, check), HasSubstr("has no camera \"cam4\""));
}

}  // namespace
}  // namespace mocap

#include "tools/track.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "config/load_config.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/text_file.h"
#include "tests/support/run_command.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/calibrate.h"
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
         "simulate --seconds 4 --fps 4 --cameras 4 --width 240 --height 180 "
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
  const std::string before = ReadText(Result() / "poses.csv");
  Calibrate(UpsideDown());
  EXPECT_THAT(Track(), AllOf(HasSubstr("all cameras hang below the floor"),
                             HasSubstr("nobody was tracked: "), HasSubstr("z points down")));
  EXPECT_EQ(ReadText(Result() / "poses.csv"), before);
}

TEST_F(WalkTracked, CamerasThatGoByEachOthersNameAreTold) {
  Calibrate(Exchanged());
  EXPECT_THAT(Track(), HasSubstr("cam1 and cam3 have each other's name"));
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
  EXPECT_THAT(Said(AddCalibrateCommand, check), HasSubstr("This calibration is good."));
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

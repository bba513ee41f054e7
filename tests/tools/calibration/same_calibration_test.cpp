#include "tools/calibration/same_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "config/load_config.h"
#include "drivers/take/calibration_file.h"
#include "tests/support/box_take.h"
#include "tests/support/run_command.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/calibrate.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class SameCalibrationTest : public ::testing::Test {
 protected:
  SameCalibrationTest() {
    testing::WriteBoxTake(take_);
    cameras_ = LoadCalibration(take_ / "calibration.toml");
  }

  const testing::TemporaryFolder folder_;
  const std::filesystem::path take_ = folder_.path() / "take", other_ = folder_.path() / "c.toml";
  std::vector<CameraCalibration> cameras_;
};

TEST_F(SameCalibrationTest, OrderAndFurtherCamerasDoNotMatter) {
  std::vector<CameraCalibration> more(cameras_.rbegin(), cameras_.rend());
  more.push_back(cameras_[0]);
  more.back().name = "further";
  EXPECT_EQ(DifferenceFrom(cameras_, more), "");
  EXPECT_EQ(DifferenceFrom(more, cameras_), "has no camera \"further\"");
}

TEST_F(SameCalibrationTest, ACameraThatMovedIsNamed) {
  std::vector<CameraCalibration> moved = cameras_;
  moved[1].X_CW.p.x() += 1;
  EXPECT_THAT(DifferenceFrom(cameras_, moved),
              HasSubstr("has camera \"north\" with other extrinsics"));
}

TEST_F(SameCalibrationTest, TheHealthOfATakeIsNotNotedInAnotherCalibration) {
  cameras_[1].X_CW.p.x() += 1;
  WriteCalibration(other_, cameras_);
  const std::string before = testing::ReadText(other_);
  EXPECT_THAT(testing::SetupErrorOf([&] {
                testing::RunCommand(AddCalibrateCommand, "calibrate health " + take_.string() +
                                                             " --note " + other_.string());
              }),
              AllOf(HasSubstr(other_.string()), HasSubstr("camera \"north\" with other extrinsics"),
                    HasSubstr((take_ / "calibration.toml").string())));
  EXPECT_EQ(testing::ReadText(other_), before);
}

TEST_F(SameCalibrationTest, AResultIsNoTake) {
  WriteCalibration(other_, cameras_);
  std::filesystem::rename(take_ / "take.toml", take_ / "poses.csv");
  const std::string other = other_.string();
  for (const std::string& command :
       {"health --note " + other + ' ', std::string("health "), "refine --out " + other + ' ',
        "check " + other + " --take "}) {
    EXPECT_THAT(testing::SetupErrorOf([&] {
                  testing::RunCommand(AddCalibrateCommand, "calibrate " + command + take_.string());
                }),
                HasSubstr("is a result of tracking, not a take"))
        << command;
  }
}

}  // namespace
}  // namespace mocap

// What a person types to calibrate, and gets wrong.
#include "tools/calibrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "config/load_config.h"
#include "drivers/take/calibration_file.h"
#include "tests/support/run_command.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/walking_moments.h"
#include "tools/calibrate_steps.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Six cameras around a room, and a command about them.
class CalibrateCommand : public ::testing::Test {
 protected:
  CalibrateCommand() { WriteCalibration(In("right.toml"), testing::WalkCameras()); }

  std::string In(const std::string& name) const { return (folder_.path() / name).string(); }

  /// What the command says and how it fails, in one text.
  static std::string Says(const std::string& command) {
    ::testing::internal::CaptureStdout();
    std::string failure;
    try {
      testing::RunCommand(AddCalibrateCommand, "calibrate " + command);
    } catch (const std::exception& error) {
      failure = error.what();
    }
    return ::testing::internal::GetCapturedStdout() + failure;
  }
  static double DistanceOf(const std::vector<CameraCalibration>& cameras) {
    return (cameras[0].X_CW.Inverse().p - cameras[3].X_CW.Inverse().p).norm();
  }

  const testing::TemporaryFolder folder_;
};

TEST_F(CalibrateCommand, WhatCannotBeReadOrWrittenIsToldBeforeTheSearch) {
  const std::string footage = In("none"), board = " --board chess:8x5:100 ";
  fs::create_directory(In("folder"));
  // The footage would be missed next.
  for (const auto& [options, told] :
       {std::pair("--out " + In("none/c.toml"), "none/c.toml: cannot be written"),
        std::pair("--out " + In("folder"), "folder: cannot be written"),
        std::pair("--out c.toml --report " + In("none/c.html"), "none/c.html: cannot be written"),
        std::pair("--out c.toml --report " + In("c.pdf"), "c.pdf: does not end in .html"),
        std::pair("--out " + In("c.toml") + " --floor " + In("lying"), "lying: not found"),
        std::pair("--out " + In("c.toml") + " --floor-points " + In("p.csv"), "p.csv: not found"),
        std::pair("--out " + In("c.toml") + " --distance cam1:cam4", "CAMERA:CAMERA:MM")}) {
    EXPECT_THAT(Says("studio " + footage + board + options), HasSubstr(told));
  }
  EXPECT_THAT(Says("extrinsics " + footage + board + "--out " + In("c.toml") + " --intrinsics " +
                   In("lenses.toml")),
              HasSubstr("lenses.toml: not found"));
  EXPECT_THAT(Says("intrinsics " + footage + board + "--out " + In("folder")),
              HasSubstr("folder: cannot be written"));
  for (const std::string& command :
       {"refine " + footage, "pan-tilt " + footage + board + "--footage " + footage})
    EXPECT_THAT(Says(command + " --out " + In("folder")), HasSubstr("folder: cannot be written"));
  EXPECT_THAT(Says("health " + footage + " --note " + In("folder")),
              HasSubstr("folder: cannot be written"));
}

TEST_F(CalibrateCommand, CamerasThatTheFootageLacksAreToldBeforeTheSearch) {
  testing::WriteSmallTake(In("carried"), {});
  testing::WriteText(In("p.csv"), "origin,cam77,3,4\n");
  const std::string studio =
      "studio " + In("carried") + " --board chess:8x5:100 --out " + In("c.toml");
  EXPECT_THAT(Says(studio + " --floor-points " + In("p.csv")),
              HasSubstr("p.csv:1: there is no camera \"cam77\"; expected one of cam1"));
  EXPECT_THAT(Says(studio + " --distance cam1:cam77:5000"),
              HasSubstr("there is no camera \"cam77\""));
}

TEST_F(CalibrateCommand, ATapeAloneSetsTheScale) {
  const double before_mm = DistanceOf(testing::WalkCameras());
  const std::string said = Says("floor " + In("right.toml") + " --set-scale --distance cam1:cam4:" +
                                std::to_string(1.1 * before_mm) + " --out " + In("c.toml"));
  EXPECT_THAT(said, AllOf(HasSubstr("note: cam1 and cam4 are "), HasSubstr(" mm by the tape"),
                          HasSubstr("is good"), Not(HasSubstr("the floor is not set")),
                          HasSubstr("written: " + In("c.toml") + "\n")));
  EXPECT_NEAR(DistanceOf(LoadCalibration(In("c.toml"))), 1.1 * before_mm, 0.01);
}

TEST_F(CalibrateCommand, WhatAnOptionNeedsIsNamed) {
  const std::string floor = "floor " + In("right.toml") + " --out " + In("c.toml");
  EXPECT_THAT(Says(floor), HasSubstr("expected --floor, --floor-points, or --distance with"));
  EXPECT_THAT(Says(floor + " --floor " + In("lying")), HasSubstr("--floor requires --board"));
  EXPECT_THAT(Says(floor + " --set-scale"), HasSubstr("--set-scale requires --distance"));
  EXPECT_THAT(Says(floor + " --floor-points a --board chess:8x5:100 --floor b"),
              HasSubstr("--floor excludes --floor-points"));
}

TEST_F(CalibrateCommand, WhatWasNotMeasuredIsNoZero) {
  StudioFit fit;
  fit.detections.board = ParseBoard("chess:8x5:100");
  fit.bundle.cameras = testing::WalkCameras();
  for (const CameraCalibration& camera : fit.bundle.cameras) {
    CameraFit& one = fit.cameras.emplace_back();
    one.name = camera.name;
    one.lens_rms_px = 0.25;
  }
  EXPECT_THAT(FitText(fit, {}), HasSubstr("cam1            0    0.250        -           -"));
  EXPECT_THAT(FitJson(fit, {}),
              AllOf(HasSubstr("\"lens_rms_px\":0.25"), Not(HasSubstr("\"rms_mm\""))));
}

TEST_F(CalibrateCommand, ATapeInMetresIsNoDistanceOfCameras) {
  EXPECT_THAT(Says("check " + In("right.toml") + " --distance cam1:cam4:8.112"),
              HasSubstr("8.112 mm do not lie between two cameras; expected millimetres"));
}

}  // namespace
}  // namespace mocap

#include "core/calibration/camera_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/walking_moments.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<CameraCalibration> Studio() { return testing::WalkCameras(); }

TEST(CameraPlaces, AStudioIsPlausible) { EXPECT_THAT(CheckPlaces(Studio(), true), IsEmpty()); }

TEST(CameraPlaces, LengthsInInchesAreDoubted) {
  std::vector<CameraCalibration> cameras = Studio();
  for (CameraCalibration& camera : cameras) camera.X_CW.p /= 25.4;
  const std::vector<Finding> findings = CheckPlaces(cameras, true);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].severity, Severity::kWarning);
  EXPECT_THAT(findings[0].text,
              AllOf(HasSubstr("inches"), HasSubstr("expected lengths in millimetres")));
}

TEST(CameraPlaces, WhatConcernsAllCamerasIsToldOnce) {
  std::vector<CameraCalibration> in_metres = Studio(), lenses = Studio();
  for (CameraCalibration& camera : in_metres) camera.X_CW.p /= 1000;
  for (CameraCalibration& camera : lenses) camera.X_CW = {};
  const std::vector<Finding> metres = CheckPlaces(in_metres, true);
  ASSERT_THAT(metres, SizeIs(1));
  EXPECT_EQ(metres[0].severity, Severity::kWrong);
  EXPECT_THAT(metres[0].text, AllOf(HasSubstr("all cameras stand within"), HasSubstr("metres")));
  const std::vector<Finding> no_poses = CheckPlaces(lenses, true);
  ASSERT_THAT(no_poses, SizeIs(1));
  EXPECT_THAT(no_poses[0].text, HasSubstr("cam1, cam2, cam3, cam4, cam5 and cam6: at the origin"));
}

TEST(CameraPlaces, AFloorThatIsUpsideDownIsToldOnce) {
  std::vector<CameraCalibration> cameras = Studio();
  for (CameraCalibration& camera : cameras) camera.X_CW.R.rightCols<2>() *= -1;
  const std::vector<Finding> findings = CheckPlaces(cameras, true);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].severity, Severity::kWrong);
  EXPECT_THAT(findings[0].text, HasSubstr("z points down"));
  EXPECT_THAT(CheckPlaces(cameras, false), IsEmpty()) << "without a floor, heights mean nothing";
}

TEST(CameraPlaces, OneCameraBelowTheFloorIsNamed) {
  std::vector<CameraCalibration> cameras = Studio();
  const Vector3 p_WC = cameras[3].X_CW.Inverse().p;
  cameras[3].X_CW.p = -(cameras[3].X_CW.R * Vector3(p_WC.x(), p_WC.y(), -500));
  const std::vector<Finding> findings = CheckPlaces(cameras, true);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].text, HasSubstr("cam4: hangs 500 mm below the floor"));
}

}  // namespace
}  // namespace mocap

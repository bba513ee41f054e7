#include "tools/report/body_outline.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mocap {
namespace {

/// Stands 5 m before a camera that looks along world x with z up; the person faces the camera's
/// way.
CameraCalibration Behind() {
  CameraCalibration camera;
  camera.width_px = 640;
  camera.height_px = 480;
  OpenCvLens lens;
  lens.K << 500, 0, 320, 0, 500, 240, 0, 0, 1;
  camera.lens = lens;
  Matrix3 R_CW;
  R_CW << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  camera.X_CW = {R_CW, -(R_CW * Vector3(-5000, 0, 1000))};
  return camera;
}

PoseRow Standing() {
  PoseRow row;
  row.has_pose = true;
  const auto put = [&](Point point, double y, double z) {
    row.points_W.col(static_cast<int>(point)) = Vector3(0, y, z);
  };
  put(Point::kTorso, 0, 1200);
  put(Point::kNeck, 0, 1500);
  put(Point::kHead, 0, 1650);
  put(Point::kShoulderL, 200, 1450);
  put(Point::kShoulderR, -200, 1450);
  put(Point::kElbowL, 500, 1450);
  put(Point::kElbowR, -500, 1450);
  put(Point::kFingertipsL, 900, 1450);
  put(Point::kFingertipsR, -900, 1450);
  put(Point::kHipL, 100, 900);
  put(Point::kHipR, -100, 900);
  put(Point::kKneeL, 100, 480);
  put(Point::kKneeR, -100, 480);
  put(Point::kFootL, 100, 30);
  put(Point::kFootR, -100, 30);
  return row;
}

BodySizes Sizes() {
  BodySizes sizes;
  sizes.torso_width = 360;
  sizes.torso_depth = 240;
  sizes.head = 240;
  sizes.head_width = 170;
  sizes.upper_arm_width = sizes.lower_arm_width = 80;
  sizes.thigh_width = sizes.calf_width = 120;
  return sizes;
}

struct Box {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
};
Box BoxOf(const BodyLine& line) {
  Box box;
  for (const Vector2& p : line.pixels) {
    box.left = std::min(box.left, p.x());
    box.right = std::max(box.right, p.x());
    box.top = std::min(box.top, p.y());
    box.bottom = std::max(box.bottom, p.y());
  }
  return box;
}

TEST(StickFigure, HasThePersonsLeftOnTheLeftSeenFromBehind) {
  const CameraCalibration camera = Behind();
  int left = 0, right = 0;
  for (const BodyLine& line : StickFigure(Standing(), camera, camera.X_CW)) {
    const double middle = (line.pixels[0].x() + line.pixels[1].x()) / 2;
    if (line.side == BodySide::kLeft) {
      ++left;
      EXPECT_LT(middle, 320);
    } else if (line.side == BodySide::kRight) {
      ++right;
      EXPECT_GT(middle, 320);
    }
  }
  EXPECT_EQ(left, 6);
  EXPECT_EQ(right, 6);
}

TEST(PartOutlines, HaveTheSizesOfTheBody) {
  const CameraCalibration camera = Behind();
  const std::vector<BodyLine> parts = PartOutlines(Standing(), Sizes(), camera, camera.X_CW);
  ASSERT_EQ(parts.size(), 10u);
  // At 5 m a pixel is 10 mm; depth changes that by a few per cent.
  const Box torso = BoxOf(parts[0]);
  EXPECT_NEAR(torso.right - torso.left, 36, 1);
  EXPECT_NEAR(torso.bottom - torso.top, 60, 2);
  const Box head = BoxOf(parts[1]);
  EXPECT_NEAR(head.right - head.left, 17, 0.6);
  EXPECT_NEAR(head.bottom - head.top, 24, 0.6);
  EXPECT_NEAR((head.top + head.bottom) / 2, 240 - 65, 0.5);
  const Box left_upper_arm = BoxOf(parts[2]);
  EXPECT_NEAR(left_upper_arm.left, 320 - 50, 1);
  EXPECT_NEAR(left_upper_arm.right, 320 - 20, 1);
  EXPECT_NEAR(left_upper_arm.bottom - left_upper_arm.top, 8, 0.5);
}

TEST(PartOutlines, LeaveOutWhatIsBehindTheCamera) {
  CameraCalibration camera = Behind();
  camera.X_CW = RotationAbout(Vector3::UnitY(), Vector3::Zero(), 3.14159) * camera.X_CW;
  EXPECT_TRUE(PartOutlines(Standing(), Sizes(), camera, camera.X_CW).empty());
  EXPECT_TRUE(StickFigure(Standing(), camera, camera.X_CW).empty());
}

}  // namespace
}  // namespace mocap

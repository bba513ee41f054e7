#include "daemon/messages/look_region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mocap {
namespace {

/// At the world's x axis and level: the picture's up is the world's, 500 px at 1 m.
CameraCalibration LevelCamera() {
  CameraCalibration camera;
  camera.name = "cam1";
  camera.width_px = 640;
  camera.height_px = 480;
  OpenCvLens lens;
  lens.K << 500, 0, 320, 0, 500, 240, 0, 0, 1;
  camera.lens = lens;
  camera.X_CW.R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return camera;
}

std::vector<PosedCapsule> Post(double x_mm, double y_mm) {
  return {PosedCapsule({x_mm, y_mm, -800}, {x_mm, y_mm, 600}, 100, 100)};
}

std::optional<LookRegion> RegionOfPost(double x_mm, double y_mm) {
  const CameraCalibration camera = LevelCamera();
  return RegionAround(Post(x_mm, y_mm), camera, camera.X_CW);
}

TEST(LookRegion, IsASquareAroundTheBodyWithAMargin) {
  const auto region = RegionOfPost(5000, 0);
  ASSERT_TRUE(region);
  // 1600 mm high at 5 m, from 170 to 330 px.
  EXPECT_EQ(region->side_px, 200);
  EXPECT_NEAR(region->left_px + 100, 320, 1);
  EXPECT_NEAR(region->top_px + 100, 250, 1);
  EXPECT_NEAR((region->up - Vector2(0, -1)).norm(), 0, 1e-9);
}

TEST(LookRegion, KnowsWhichWayIsUp) {
  CameraCalibration camera = LevelCamera();
  Matrix3 quarter_turn;
  quarter_turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  camera.X_CW.R = quarter_turn * camera.X_CW.R;
  const auto region = RegionAround(Post(5000, 0), camera, camera.X_CW);
  ASSERT_TRUE(region);
  EXPECT_NEAR((region->up - Vector2(1, 0)).norm(), 0, 1e-9);
}

TEST(LookRegion, IsNoneWhereThePictureDoesNotShowTheBody) {
  EXPECT_FALSE(RegionOfPost(5000, 8000));
  EXPECT_FALSE(RegionOfPost(-5000, 0)) << "behind the camera";
  EXPECT_FALSE(RegionAround({}, LevelCamera(), {}));
}

TEST(LookRegion, OfSomebodyCloseToTheCameraIsBounded) {
  const auto region = RegionOfPost(300, 0);
  ASSERT_TRUE(region);
  EXPECT_EQ(region->side_px, 960);
  EXPECT_NEAR(region->left_px + 480, 320, 1);
  EXPECT_NEAR(region->top_px + 480, 240, 1);
}

TEST(LookRegion, IsBlackOutsideOfThePicture) {
  Image<Bgr> picture(4, 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) picture(x, y) = {static_cast<std::uint8_t>(10 * x + y), 1, 2};
  }
  Image<Bgr> cut(1, 1, Bgr{9, 9, 9});
  CutRegion(picture.view(), {.left_px = 2, .top_px = -1, .side_px = 3}, cut);
  ASSERT_EQ(cut.width(), 3);
  ASSERT_EQ(cut.height(), 3);
  EXPECT_EQ(cut(0, 0), Bgr());
  EXPECT_EQ(cut(0, 1), (Bgr{20, 1, 2}));
  EXPECT_EQ(cut(1, 2), (Bgr{31, 1, 2}));
  EXPECT_EQ(cut(2, 2), Bgr());
  CutRegion(picture.view(), {.left_px = 100, .top_px = 0, .side_px = 3}, cut);
  EXPECT_EQ(cut(0, 0), Bgr()) << "beside it, nothing remains of the cut before";
}

}  // namespace
}  // namespace mocap

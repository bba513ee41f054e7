// Borders of silhouettes as rays.
#include "tools/import/silhouette_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

CameraCalibration TestCamera() {
  CameraCalibration camera;
  camera.width_px = 200;
  camera.height_px = 100;
  OpenCvLens lens;
  lens.K << 100, 0, 100, 0, 100, 50, 0, 0, 1;
  lens.distortion[0] = 0.1;
  camera.lens = lens;
  camera.X_CW = {ExpRotation({0.3, -0.2, 0.5}), {100, 200, 3000}};
  return camera;
}

void Fill(const PixelBox& box, Silhouette& silhouette) {
  for (int y = box.top; y <= box.bottom; ++y)
    for (int x = box.left; x <= box.right; ++x) silhouette.Set(x, y);
}

/// Whether a corner shows a pixel.
bool Shows(const HullCorner& corner, const CameraCalibration& camera, double x, double y) {
  const Vector3 ray_C = camera.X_CW.R * corner.ray_W;
  const auto pixel = PixelFromNormalized(camera.lens, ray_C.head<2>() / ray_C.z());
  return pixel && (*pixel - Vector2(x, y)).norm() < 0.01;
}

TEST(HullOf, HasTheCornersOfABox) {
  const CameraCalibration camera = TestCamera();
  Silhouette silhouette(200, 100);
  Fill({60, 20, 80, 70}, silhouette);
  Fill({75, 30, 78, 40}, silhouette);
  const std::vector<HullCorner> corners = HullOf(silhouette, camera);
  for (const auto& [x, y] : {std::pair{60, 20}, {80, 20}, {60, 70}, {80, 70}}) {
    EXPECT_TRUE(std::ranges::any_of(
        corners, [&](const HullCorner& corner) { return Shows(corner, camera, x, y); }))
        << x << ' ' << y;
  }
  for (const HullCorner& corner : corners) {
    EXPECT_NEAR(corner.ray_W.norm(), 1, 1e-12);
    EXPECT_FALSE(corner.is_at_edge);
  }
}

TEST(HullOf, KnowsWhereThePictureEnds) {
  Silhouette silhouette(200, 100);
  Fill({60, 20, 80, 99}, silhouette);
  const std::vector<HullCorner> corners = HullOf(silhouette, TestCamera());
  const auto at_edge = std::ranges::count_if(corners, &HullCorner::is_at_edge);
  EXPECT_GE(at_edge, 2);
  EXPECT_LT(at_edge, std::ssize(corners));
}

TEST(HullOf, IsEmptyForNobody) { EXPECT_TRUE(HullOf(Silhouette(200, 100), TestCamera()).empty()); }

TEST(LargestPart, LeavesOutTheOthers) {
  Silhouette silhouette(200, 100), wanted(200, 100);
  Fill({10, 10, 20, 30}, silhouette);
  Fill({150, 50, 170, 90}, silhouette);
  Fill({150, 50, 170, 90}, wanted);
  EXPECT_EQ(LargestPart(silhouette).words(), wanted.words());
  EXPECT_FALSE(LargestPart(Silhouette(200, 100)).BoundingBox());
}

}  // namespace
}  // namespace mocap

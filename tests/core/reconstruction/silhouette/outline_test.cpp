#include "core/reconstruction/silhouette/outline.h"

#include <gtest/gtest.h>

#include "tests/core/reconstruction/lenses.h"

namespace mocap {
namespace {

constexpr double kRadius_mm = 400;
const Vector3 kCenter_C(150, -100, 3000);

bool SphereIsSeen(const CameraCalibration& camera, int x, int y) {
  const auto normalized = NormalizedFromPixel(camera.lens, Vector2(x, y));
  if (!normalized) return false;
  const Vector3 direction = Vector3(normalized->x(), normalized->y(), 1).normalized();
  return kCenter_C.cross(direction).norm() <= kRadius_mm;
}

Silhouette SphereSeenBy(const CameraCalibration& camera) {
  Silhouette silhouette(camera.width_px, camera.height_px);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      if (SphereIsSeen(camera, x, y)) silhouette.Set(x, y);
    }
  }
  return silhouette;
}

// How far a ray passes outside the sphere, and the way there.
Vector3 OffsetFromCenter(const GrazingRay& ray, const Vector3& center_W) {
  const Vector3 to_center = center_W - ray.eye_W;
  return ray.eye_W + to_center.dot(ray.direction_W) * ray.direction_W - center_W;
}

TEST(Outline, RaysGrazeWhatTheLensShows) {
  RigidTransform X_CW{ExpRotation(Vector3(0.3, -0.8, 0.2)), Vector3(100, 200, 300)};
  const Vector3 center_W = X_CW.Inverse() * kCenter_C;
  for (const NamedCamera& camera : DistortedCameras()) {
    Outline outline;
    TraceOutline(camera.calibration, X_CW, {SphereSeenBy(camera.calibration), {}}, 100, outline);
    ASSERT_GT(outline.size(), 90u) << camera.name;
    ASSERT_LE(outline.size(), 100u) << camera.name;
    double bias_mm = 0;
    for (const GrazingRay& ray : outline) {
      const Vector3 offset = OffsetFromCenter(ray, center_W);
      bias_mm += (offset.norm() - kRadius_mm) / static_cast<double>(outline.size());
      // A pixel is 6 to 10 mm wide there.
      EXPECT_NEAR(offset.norm(), kRadius_mm, 8) << camera.name;
      EXPECT_GT(ray.outward_W.dot(offset.normalized()), 0.97) << camera.name;
      EXPECT_NEAR(ray.outward_W.dot(ray.direction_W), 0, 1e-9);
    }
    EXPECT_NEAR(bias_mm, 0, 1.5) << camera.name;
  }
}

TEST(Outline, HasNoRaysBesideUnknownPixels) {
  const CameraCalibration camera = DistortedCameras()[0].calibration;
  const Silhouette sphere = SphereSeenBy(camera);
  const PixelBox box = *sphere.BoundingBox();
  const int middle = (box.left + box.right) / 2;
  Silhouette unknown(camera.width_px, camera.height_px);
  for (int y = 0; y < camera.height_px; ++y)
    for (int x = middle; x < camera.width_px; ++x)
      if (!sphere.Test(x, y)) unknown.Set(x, y);
  Outline outline;
  TraceOutline(camera, RigidTransform{}, {sphere, unknown}, 100, outline);
  EXPECT_GT(outline.size(), 90u);
  for (const GrazingRay& ray : outline) {
    const Vector2 pixel = PixelFromNormalized(camera.lens, ray.direction_W.hnormalized()).value();
    EXPECT_LT(pixel.x(), middle + 1);
  }
}

TEST(Outline, KeepsItsRaysWhereNothingChanges) {
  const CameraCalibration camera = DistortedCameras()[0].calibration;
  Silhouette silhouette = SphereSeenBy(camera);
  Outline before, after;
  TraceOutline(camera, RigidTransform{}, {silhouette, {}}, 100, before);
  for (int y = 20; y < 32; ++y)
    for (int x = 20; x < 32; ++x) silhouette.Set(x, y);
  TraceOutline(camera, RigidTransform{}, {silhouette, {}}, 100, after);
  const auto is_old = [&](const GrazingRay& ray) {
    return std::ranges::any_of(before, [&](const GrazingRay& old) {
      return old.rank == ray.rank && old.direction_W == ray.direction_W;
    });
  };
  // What is new has a tenth of the border.
  EXPECT_GE(std::ranges::count_if(after, is_old), 80);
}

TEST(Outline, EveryThirdPartIsATraceOfAThirdAsMany) {
  const CameraCalibration camera = DistortedCameras()[0].calibration;
  const RigidTransform X_CW{ExpRotation(Vector3(0.3, -0.8, 0.2)), Vector3(100, 200, 300)};
  const Silhouette sphere = SphereSeenBy(camera);
  Outline thin, dense, thinned;
  TraceOutline(camera, X_CW, {sphere, {}}, 60, thin);
  TraceOutline(camera, X_CW, {sphere, {}}, 180, dense);
  ThinOutline(dense, 3, thinned);
  std::erase_if(thin, [](const GrazingRay& ray) { return ray.empty(); });
  ASSERT_EQ(thinned.size(), thin.size());
  for (std::size_t i = 0; i < thin.size(); ++i) {
    EXPECT_EQ(thinned[i].direction_W, thin[i].direction_W);
    EXPECT_EQ(thinned[i].outward_W, thin[i].outward_W);
  }
}

TEST(Outline, HolesBorderOnTheirInside) {
  const CameraCalibration camera = DistortedCameras()[0].calibration;
  Silhouette frame(camera.width_px, camera.height_px);
  for (int y = 100; y < 300; ++y) {
    for (int x = 100; x < 300; ++x) {
      if (x < 150 || x >= 250 || y < 150 || y >= 250) frame.Set(x, y);
    }
  }
  Outline outline;
  TraceOutline(camera, RigidTransform{}, {frame, {}}, 400, outline);
  const auto middle = NormalizedFromPixel(camera.lens, Vector2(200, 200));
  const Vector3 to_middle = Vector3(middle->x(), middle->y(), 1).normalized();
  int inward = 0;
  for (const GrazingRay& ray : outline)
    inward += ray.outward_W.dot(to_middle - ray.direction_W) > 0;
  // The hole's border is half as long as the outer one.
  EXPECT_NEAR(inward, static_cast<double>(outline.size()) / 3, 15);
}

TEST(Outline, EndsWhereThePictureEnds) {
  const CameraCalibration camera = DistortedCameras()[0].calibration;
  Silhouette everything(camera.width_px, camera.height_px);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) everything.Set(x, y);
  }
  Outline outline(3);
  TraceOutline(camera, RigidTransform{}, {everything, {}}, 100, outline);
  EXPECT_TRUE(outline.empty());
  TraceOutline(camera, RigidTransform{}, {Silhouette(camera.width_px, camera.height_px), {}}, 100,
               outline);
  EXPECT_TRUE(outline.empty());
}

}  // namespace
}  // namespace mocap

#include "tools/witness/picture_region.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mocap {
namespace {

/// What networks of this kind are trained with.
constexpr double kMargin = 1.25;
/// Nearer to the lens, or behind it, nothing is seen.
constexpr double kNearest_mm = 100;

std::optional<Vector2> PixelOf(const CameraCalibration& camera, const Vector3& p_C) {
  if (p_C.z() < kNearest_mm) return std::nullopt;
  return PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
}

bool IsInPicture(const CameraCalibration& camera, const Vector2& px) {
  return px.x() >= 0 && px.y() >= 0 && px.x() <= camera.width_px - 1 &&
         px.y() <= camera.height_px - 1;
}

void ExtendByBall(const CameraCalibration& camera, const Vector3& middle_C, double radius_mm,
                  Eigen::AlignedBox2d& box_px) {
  for (const double side : {-radius_mm, radius_mm})
    for (const Vector3 towards : {Vector3::UnitX(), Vector3::UnitY()})
      if (const auto px = PixelOf(camera, middle_C + side * towards)) box_px.extend(*px);
}

/// Turns by which the direction that shows upwards in the room becomes that in the picture.
int TurnsAt(const CameraCalibration& camera, const RigidTransform& X_CW, const Vector3& p_W) {
  const auto below = PixelOf(camera, X_CW * p_W);
  const auto above = PixelOf(camera, X_CW * (p_W + 100 * Vector3::UnitZ()));
  if (!below || !above) return 0;
  return TurnsFor(*above - *below);
}

}  // namespace

int TurnsFor(const Vector2& up) {
  const double quarters = std::atan2(-up.x(), -up.y()) / (std::numbers::pi / 2);
  return static_cast<int>(std::lround(quarters) + 4) % 4;
}

CropMap MapOf(const PictureRegion& region, int crop_width_px, int crop_height_px) {
  constexpr std::array<int, 4> kCosines = {1, 0, -1, 0};
  const double c = kCosines[region.turns], s = kCosines[(region.turns + 3) % 4];
  CropMap map;
  // To the right in the crop, and downwards.
  map.turn_and_scale.col(0) = Vector2(c, -s) * (region.width_px / crop_width_px);
  map.turn_and_scale.col(1) = Vector2(s, c) * (region.height_px / crop_height_px);
  map.origin_px = region.middle_px - map.turn_and_scale * Vector2((crop_width_px - 1) / 2.0,
                                                                  (crop_height_px - 1) / 2.0);
  return map;
}

std::optional<SeenBox> SeeBody(std::span<const PosedCapsule> capsules,
                               const CameraCalibration& camera, const RigidTransform& X_CW) {
  Eigen::AlignedBox2d box_px;
  Eigen::AlignedBox3d body_W;
  std::size_t in_picture = 0;
  for (const PosedCapsule& capsule : capsules) {
    ExtendByBall(camera, X_CW * capsule.a_W, capsule.radius_a_mm, box_px);
    ExtendByBall(camera, X_CW * capsule.b_W, capsule.radius_b_mm, box_px);
    for (const Vector3& end_W : {capsule.a_W, capsule.b_W}) {
      body_W.extend(end_W);
      const auto px = PixelOf(camera, X_CW * end_W);
      in_picture += px && IsInPicture(camera, *px);
    }
  }
  if (box_px.isEmpty()) return std::nullopt;
  SeenBox seen;
  seen.in_picture = static_cast<double>(in_picture) / static_cast<double>(2 * capsules.size());
  seen.box.turns = TurnsAt(camera, X_CW, body_W.center());
  seen.box.middle_px = box_px.center();
  seen.box.width_px = box_px.sizes()[seen.box.turns % 2];
  seen.box.height_px = box_px.sizes()[1 - seen.box.turns % 2];
  return seen;
}

PictureRegion RegionAround(const PictureRegion& box, double aspect) {
  PictureRegion region = box;
  region.height_px = kMargin * std::max(box.height_px, box.width_px / aspect);
  region.width_px = region.height_px * aspect;
  return region;
}

}  // namespace mocap

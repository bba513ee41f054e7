#include "tools/witness/picture_region.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/evidence/body_in_picture.h"

namespace mocap {
namespace {

/// What networks of this kind are trained with.
constexpr double kMargin = 1.25;

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
  const auto body = FindInPicture(capsules, camera, X_CW);
  if (!body) return std::nullopt;
  SeenBox seen;
  seen.in_picture = body->share;
  seen.box.turns = body->up ? TurnsFor(*body->up) : 0;
  seen.box.middle_px = body->box_px.center();
  seen.box.width_px = body->box_px.sizes()[seen.box.turns % 2];
  seen.box.height_px = body->box_px.sizes()[1 - seen.box.turns % 2];
  return seen;
}

PictureRegion RegionAround(const PictureRegion& box, double aspect) {
  PictureRegion region = box;
  region.height_px = kMargin * std::max(box.height_px, box.width_px / aspect);
  region.width_px = region.height_px * aspect;
  return region;
}

}  // namespace mocap

#include "core/tracking/protrusion.h"

#include <cmath>

namespace mocap {
namespace {

constexpr double kReachMm = 150;
// A border that is nearest but runs past the ball, as one that the picture's edge cuts off does,
// does not tell which side the ball is on.
constexpr double kLeastFacing = 0.5;

}  // namespace

std::optional<Protrusion> ProtrusionOf(const Outline& outline, const Vector3& center_W,
                                       double radius_mm) {
  if (outline.empty()) return std::nullopt;
  const Vector3 sight_W = center_W - outline.front().eye_W;
  const GrazingRay* nearest = nullptr;
  double farthest_mm = 0;
  for (const GrazingRay& ray : outline) {
    const double along_mm = ray.direction_W.dot(sight_W);
    if (along_mm <= farthest_mm) continue;
    farthest_mm = along_mm;
    nearest = &ray;
  }
  if (nearest == nullptr) return std::nullopt;
  const double apart_mm = nearest->direction_W.cross(sight_W).norm();
  const double beyond_mm = nearest->outward_W.dot(sight_W);
  if (apart_mm > kReachMm || std::abs(beyond_mm) < kLeastFacing * apart_mm) return std::nullopt;
  if (beyond_mm + radius_mm <= 0) return std::nullopt;
  return Protrusion{nearest->outward_W, beyond_mm + radius_mm};
}

}  // namespace mocap

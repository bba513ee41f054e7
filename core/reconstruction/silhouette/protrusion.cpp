#include "core/reconstruction/silhouette/protrusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mocap {
namespace {

using Rays = kernels::RayBlock;
constexpr int kRays = Rays::kRays;

constexpr double kProtrusionMm = 150;
// If the nearest border runs past the ball, as at the picture's edge, it does not show on which
// side the ball is.
constexpr double kLeastFacing = 0.5;

}  // namespace

void SilhouetteBorder::SetOutline(const Outline& outline) {
  outline_ = &outline;
  blocks_.assign((outline.size() + kRays - 1) / kRays, Rays{});
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector3f direction_W = outline[i].direction_W.cast<float>();
    Rays& block = blocks_[i / kRays];
    block.x[i % kRays] = direction_W.x();
    block.y[i % kRays] = direction_W.y();
    block.z[i % kRays] = direction_W.z();
  }
}

std::optional<Protrusion> SilhouetteBorder::ProtrusionOf(const Vector3& center_W,
                                                         double radius_mm) const {
  if (outline_ == nullptr || outline_->empty()) return std::nullopt;
  const Vector3 sight_W = center_W - outline_->front().eye_W;
  const Eigen::Vector3f sight = sight_W.cast<float>();
  const int nearest = kernels::FindFarthestRay(blocks_.data(), static_cast<int>(blocks_.size()),
                                               {sight.x(), sight.y(), sight.z()});
  if (nearest < 0) return std::nullopt;
  const GrazingRay& ray = (*outline_)[nearest];
  const double beyond_mm = ray.outward_W.dot(sight_W);
  if (beyond_mm + radius_mm <= 0) return std::nullopt;
  const double apart_mm = ray.direction_W.cross(sight_W).norm();
  if (apart_mm > kProtrusionMm || std::abs(beyond_mm) < kLeastFacing * apart_mm)
    return std::nullopt;
  return Protrusion{ray.outward_W, beyond_mm + radius_mm};
}

}  // namespace mocap

#include "core/tracking/protrusion.h"

#include <cmath>

#include "core/vectorized.h"

namespace mocap {
namespace {

using Block = SilhouetteBorder::Block;
constexpr int kLanes = SilhouetteBorder::kLanes;

constexpr double kReachMm = 150;
// A border that is nearest but runs past the ball, as one that the picture's edge cuts off does,
// does not tell which side the ball is on.
constexpr double kLeastFacing = 0.5;

// The ray that goes farthest along a line of sight from the same eye, and so passes nearest to its
// end; -1: all lead away.
MOCAP_VECTORIZED
int NearestRay(const Block* blocks, int count, float x, float y, float z) {
  std::array<float, kLanes> farthest{};
  std::array<int, kLanes> block_of{};
  for (int block = 0; block < count; ++block) {
    const Block& rays = blocks[block];
    for (int lane = 0; lane < kLanes; ++lane) {
      const float along = rays.x[lane] * x + rays.y[lane] * y + rays.z[lane] * z;
      const bool is_farther = along > farthest[lane];
      farthest[lane] = is_farther ? along : farthest[lane];
      block_of[lane] = is_farther ? block : block_of[lane];
    }
  }
  std::array<int, kLanes> ray;
  for (int lane = 0; lane < kLanes; ++lane) ray[lane] = block_of[lane] * kLanes + lane;
  for (int half = kLanes / 2; half > 0; half /= 2) {
    for (int lane = 0; lane < half; ++lane) {
      const bool is_farther = farthest[lane + half] > farthest[lane];
      farthest[lane] = is_farther ? farthest[lane + half] : farthest[lane];
      ray[lane] = is_farther ? ray[lane + half] : ray[lane];
    }
  }
  return farthest[0] > 0 ? ray[0] : -1;
}

}  // namespace

void SilhouetteBorder::SetOutline(const Outline& outline) {
  outline_ = &outline;
  blocks_.assign((outline.size() + kLanes - 1) / kLanes, Block{});
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector3f direction_W = outline[i].direction_W.cast<float>();
    Block& block = blocks_[i / kLanes];
    block.x[i % kLanes] = direction_W.x();
    block.y[i % kLanes] = direction_W.y();
    block.z[i % kLanes] = direction_W.z();
  }
}

std::optional<Protrusion> SilhouetteBorder::ProtrusionOf(const Vector3& center_W,
                                                         double radius_mm) const {
  if (outline_ == nullptr || outline_->empty()) return std::nullopt;
  const Vector3 sight_W = center_W - outline_->front().eye_W;
  const Eigen::Vector3f sight = sight_W.cast<float>();
  const int nearest =
      NearestRay(blocks_.data(), static_cast<int>(blocks_.size()), sight.x(), sight.y(), sight.z());
  if (nearest < 0) return std::nullopt;
  const GrazingRay& ray = (*outline_)[nearest];
  const double beyond_mm = ray.outward_W.dot(sight_W);
  if (beyond_mm + radius_mm <= 0) return std::nullopt;
  const double apart_mm = ray.direction_W.cross(sight_W).norm();
  if (apart_mm > kReachMm || std::abs(beyond_mm) < kLeastFacing * apart_mm) return std::nullopt;
  return Protrusion{ray.outward_W, beyond_mm + radius_mm};
}

}  // namespace mocap

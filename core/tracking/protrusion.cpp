#include "core/tracking/protrusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/lanes.h"

namespace mocap {
namespace {

using Block = SilhouetteBorder::Block;
constexpr int kRays = SilhouetteBorder::kRays;
// Tie-break between equally near rays: even lanes first.
constexpr std::array<std::uint32_t, kFloats> kOrder = {7, 3, 5, 1, 6, 2, 4, 0};
constexpr std::array<int, kFloats> kLaneOf = {7, 3, 5, 1, 6, 2, 4, 0};

constexpr double kReachMm = 150;
// If the nearest border runs past the ball, as at the picture's edge, it does not show on which
// side the ball is.
constexpr double kLeastFacing = 0.5;

// The farthest ray per lane so far, with its index.
struct Farthest {
  Floats along{};
  Ints ray{};
};

MOCAP_INLINE void TryRays(const Block& rays, int begin, int first, const Eigen::Vector3f& sight,
                          Farthest& farthest) {
  Floats x, y, z;
  LoadLanes(&rays.x[begin], x), LoadLanes(&rays.y[begin], y), LoadLanes(&rays.z[begin], z);
  const Floats along = x * sight.x() + y * sight.y() + z * sight.z();
  const Ints is_farther = along > farthest.along;
  farthest.along = is_farther ? along : farthest.along;
  farthest.ray = is_farther ? Ints{} + first : farthest.ray;
}

// Finds the ray that goes farthest along a line of sight from the same eye, and so passes nearest
// to its end; -1: all point away.
MOCAP_VECTORIZED
int NearestRay(const Block* blocks, int count, const Eigen::Vector3f& sight) {
  static_assert(kRays == 2 * kFloats);
  Farthest a, b;
  for (int block = 0; block < count; ++block) {
    TryRays(blocks[block], 0, block * kRays, sight, a);
    TryRays(blocks[block], kFloats, block * kRays + kFloats, sight, b);
  }
  const Ints is_farther = b.along > a.along;
  a.along = is_farther ? b.along : a.along;
  a.ray = is_farther ? b.ray : a.ray;
  // Non-negative floats sort like their bits; the lower half of the key holds the lane.
  std::array<std::uint32_t, kFloats> bits;
  StoreLanes(a.along, bits.data());
  std::uint64_t best = 0;
  for (int lane = 0; lane < kFloats; ++lane) {
    const std::uint64_t key = std::uint64_t{bits[lane]} << 32 | kOrder[lane];
    best = std::max(best, key);
  }
  if (best >> 32 == 0) return -1;
  const int lane = kLaneOf[best & (kFloats - 1)];
  return a.ray[lane] + lane;
}

}  // namespace

void SilhouetteBorder::SetOutline(const Outline& outline) {
  outline_ = &outline;
  blocks_.assign((outline.size() + kRays - 1) / kRays, Block{});
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector3f direction_W = outline[i].direction_W.cast<float>();
    Block& block = blocks_[i / kRays];
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
  const int nearest = NearestRay(blocks_.data(), static_cast<int>(blocks_.size()), sight);
  if (nearest < 0) return std::nullopt;
  const GrazingRay& ray = (*outline_)[nearest];
  const double beyond_mm = ray.outward_W.dot(sight_W);
  if (beyond_mm + radius_mm <= 0) return std::nullopt;
  const double apart_mm = ray.direction_W.cross(sight_W).norm();
  if (apart_mm > kReachMm || std::abs(beyond_mm) < kLeastFacing * apart_mm) return std::nullopt;
  return Protrusion{ray.outward_W, beyond_mm + radius_mm};
}

}  // namespace mocap

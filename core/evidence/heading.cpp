#include "core/evidence/heading.h"

namespace mocap {
namespace {

// Who walks this fast for this long looks ahead. Steps of a dance are shorter.
struct Walk {
  double mm_s = 600, s = 0.45;
};
constexpr Walk kWalk{};

}  // namespace

Heading HeadingWatch::Look(const VoxelCloud& cloud, double dt_s) {
  time_s_ += dt_s;
  return {feet_.ToesBeforeShins(cloud), Way(cloud.Centroid())};
}

std::optional<Vector3> HeadingWatch::Way(const Vector3& p_W) {
  way_.push_back({time_s_, p_W});
  while (way_.size() > 1 && time_s_ - way_[1].time_s >= kWalk.s) way_.erase(way_.begin());
  const double passed_s = time_s_ - way_.front().time_s;
  const Vector2 way_W = (p_W - way_.front().p_W).head<2>();
  if (passed_s < kWalk.s || way_W.norm() < kWalk.mm_s * passed_s) return std::nullopt;
  return Vector3(way_W.x(), way_W.y(), 0);
}

}  // namespace mocap

#include "core/acquisition/facing_watch.h"

#include "core/counted_time.h"

namespace mocap {
namespace {

constexpr double kLookEveryS = 0.1;
constexpr double kBackwardsAfterS = 0.3;
// Who walks this fast for this long looks ahead. Steps of a dance are shorter.
constexpr double kWalkingMmPerS = 600;
constexpr double kWalkingS = 0.45;

}  // namespace

void FacingWatch::StartOver() {
  prior_ = PosePrior(std::nullopt);
  way_.clear();
  walks_W_.reset();
  since_look_s_ = backwards_s_ = 0;
}

void FacingWatch::Look(const VoxelCloud& cloud, const PoseState& pose, double dt_s) {
  time_s_ += dt_s;
  since_look_s_ += dt_s;
  if (since_look_s_ < kLookEveryS) return;
  FollowWay(pose.X_WT.p);
  prior_ = PosePrior(feet_.ToesBeforeShins(cloud), walks_W_);
  const double counted_s = CountedS(since_look_s_);
  backwards_s_ = prior_.FacesBackwards(pose) ? backwards_s_ + counted_s : 0;
  since_look_s_ = 0;
}

void FacingWatch::FollowWay(const Vector3& p_W) {
  way_.push_back({time_s_, p_W});
  while (way_.size() > 1 && time_s_ - way_[1].time_s >= kWalkingS) way_.erase(way_.begin());
  const double passed_s = time_s_ - way_.front().time_s;
  const Vector2 way_W = (p_W - way_.front().p_W).head<2>();
  walks_W_.reset();
  if (passed_s >= kWalkingS && way_W.norm() > kWalkingMmPerS * passed_s)
    walks_W_ = Vector3(way_W.x(), way_W.y(), 0);
}

bool FacingWatch::is_backwards() const { return backwards_s_ > kBackwardsAfterS; }

}  // namespace mocap

#include "core/acquisition/facing_watch.h"

namespace mocap {
namespace {

constexpr double kLookEveryS = 0.1;
constexpr double kBackwardsAfterS = 0.3;

}  // namespace

void FacingWatch::StartOver() {
  prior_ = PosePrior(std::nullopt);
  since_look_s_ = backwards_s_ = 0;
}

void FacingWatch::Look(const VoxelCloud& cloud, const PoseState& pose, double dt_s) {
  since_look_s_ += dt_s;
  if (since_look_s_ < kLookEveryS) return;
  prior_ = PosePrior(feet_.ToesBeforeShins(cloud));
  backwards_s_ = prior_.FacesBackwards(pose) ? backwards_s_ + since_look_s_ : 0;
  since_look_s_ = 0;
}

bool FacingWatch::is_backwards() const { return backwards_s_ > kBackwardsAfterS; }

}  // namespace mocap

// Beyond the paper: notices a person who is tracked back to front.
#pragma once

#include <optional>

#include "core/acquisition/feet.h"
#include "core/acquisition/pose_prior.h"

namespace mocap {

/// Compares the pose of a tracked person with the direction of the feet, some times a second.
class FacingWatch {
 public:
  /// Forgets what was seen: another pose is tracked.
  void StartOver();

  /// Processes a frame. @param dt_s  time since the one before.
  void Look(const VoxelCloud& cloud, const PoseState& pose, double dt_s);

  /// Whether the feet have pointed backwards for long enough to look for the other facing.
  bool is_backwards() const;
  /// Prior of poses, from the last look at the feet.
  const PosePrior& prior() const { return prior_; }

 private:
  FeetFinder feet_;
  PosePrior prior_{std::nullopt};
  double since_look_s_ = 0, backwards_s_ = 0;
};

}  // namespace mocap

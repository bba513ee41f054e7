// Beyond the paper: notices a person who is tracked back to front.
#pragma once

#include <optional>
#include <vector>

#include "core/acquisition/feet.h"
#include "core/acquisition/pose_prior.h"

namespace mocap {

/// Compares the pose of a tracked person with the direction of the feet, and with the direction in
/// which the person walks, some times a second.
class FacingWatch {
 public:
  /// Forgets what was seen: another pose is tracked.
  void StartOver();

  /// Processes a frame. @param dt_s  time since the one before.
  void Look(const VoxelCloud& cloud, const PoseState& pose, double dt_s);

  /// Whether the person has faced backwards for long enough to look for the other facing.
  bool is_backwards() const;
  /// Prior of poses, from the last look.
  const PosePrior& prior() const { return prior_; }
  /// Direction in which the person walks; empty for somebody who stands or moves slowly.
  const std::optional<Vector3>& walks_W() const { return walks_W_; }

 private:
  struct Place {
    double time_s;
    Vector3 p_W;
  };
  void FollowWay(const Vector3& p_W);

  FeetFinder feet_;
  std::vector<Place> way_;  ///< Of the trunk, at the last looks.
  std::optional<Vector3> walks_W_;
  PosePrior prior_{std::nullopt};
  double time_s_ = 0, since_look_s_ = 0, backwards_s_ = 0;
};

}  // namespace mocap

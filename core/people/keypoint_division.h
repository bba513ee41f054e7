// Beyond the paper: division of keypoints among people.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/body/posed_body.h"
#include "core/evidence/keypoint_rays.h"

namespace mocap {

/// Divides views of keypoints among the people in a room. A view belongs to the person at whose
/// predicted pose it costs least, whichever way that person faces; if it is more probably of
/// something else there, to the stranger whose box most of its rays pass through, or to nobody.
/// Reuses its memory.
class KeypointDivision {
 public:
  /// For a set without views: there are no shares.
  void Clear() { shares_.clear(); }
  /// @param people     at the predicted poses.
  /// @param strangers  boxes around them.
  void Divide(std::span<const KeypointRays> views, std::span<const PosedBody> people,
              std::span<const Eigen::AlignedBox3d> strangers);

  /// One for each person, then one for each stranger, in the same order.
  const std::vector<std::vector<KeypointRays>>& shares() const { return shares_; }

 private:
  std::vector<std::vector<KeypointRays>> shares_;
};

}  // namespace mocap

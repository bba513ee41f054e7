// Beyond the paper: which poses are likely before a fit is looked at.
#pragma once

#include <optional>

#include "core/body/pose_state.h"

namespace mocap {

/// How much worse a fit counts because people seldom take its pose.
class PosePrior {
 public:
  /// @param toes_W  as of FeetFinder.
  explicit PosePrior(const std::optional<Vector3>& toes_W);

  /// Cost of a pose's orientation [mm]: little for a trunk that leans or lies, most for one upside
  /// down, or upright and turned against the feet.
  double CostMm(const PoseState& pose) const;

  /// Whether an upright trunk faces away from the feet's direction.
  bool FacesBackwards(const PoseState& pose) const { return ShareBackwards(pose) > 0.5; }

 private:
  // 0: as the feet do, or not upright; 1: the opposite way.
  double ShareBackwards(const PoseState& pose) const;

  std::optional<Vector3> toes_W_;  // Of unit length.
};

}  // namespace mocap

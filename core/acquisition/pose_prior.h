// Beyond the paper: which poses are likely before a fit is looked at.
#pragma once

#include <optional>

#include "core/body/body_model.h"
#include "core/body/pose_state.h"

namespace mocap {

/// How much worse a fit counts because people seldom take its pose.
class PosePrior {
 public:
  /// @param toes_W   as of FeetFinder.
  /// @param walks_W  direction in which the person walks, if so; of any length.
  explicit PosePrior(const std::optional<Vector3>& toes_W,
                     const std::optional<Vector3>& walks_W = std::nullopt);

  /// Cost of a pose's orientation [mm]: little for a trunk that leans or lies, most for one upside
  /// down, or upright and turned against the feet or the way.
  double CostMm(const PoseState& pose) const;
  /// Likewise of a body in this pose. Joints far from their rest cost more. So do the unusually
  /// tall and a drape, which explain a little more of anything.
  double CostMm(const BodyModel& body, const PoseState& pose) const;

  /// Whether an upright trunk faces away from where the feet point; without feet, from where the
  /// person walks.
  bool FacesBackwards(const PoseState& pose) const { return ShareBackwards(pose) > 0.5; }

 private:
  // 0: as the feet do, or not upright; 1: the opposite way.
  double ShareBackwards(const PoseState& pose) const;

  std::optional<Vector3> ahead_W_;  // Of unit length.
  double backwards_mm_ = 0;
};

}  // namespace mocap

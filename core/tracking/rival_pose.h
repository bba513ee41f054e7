// Beyond the paper: a second hypothesis about the pose. One frame does not tell arms that cross
// from arms that touch, or a limb from a shadow of the hull; some frames do.
#pragma once

#include "core/body/body_model.h"
#include "core/tracking/pose_filter.h"
#include "core/tracking/surface_fit.h"

namespace mocap {

/// How much less a pose must cost [mm], for a time `dt_s` to decide between it and another; without
/// limit as dt_s goes to 0.
double ClearLeadMm(double dt_s);

/// Follows another pose beside the present one, until one of them explains the evidence clearly
/// better over several frames.
class RivalPose {
 public:
  /// Starts beside `present`, whose uncertainty it takes over.
  RivalPose(const PoseFilter& present, const PoseState& pose, double cost_mm);

  enum class Rank { kUndecided, kBetter, kWorse };

  /// Follows the body into the next frame and compares.
  /// @param fit              holds the frame's evidence.
  /// @param present_cost_mm  of the present pose in this frame.
  Rank Follow(const BodyModel& body, SurfaceFit& fit, const PoseState& present,
              double present_cost_mm, double dt_s);

  const PoseFilter& filter() const { return filter_; }
  /// Cost in the last frame.
  double cost_mm() const { return cost_mm_; }

 private:
  PoseFilter filter_;
  double cost_mm_;
  double lead_mm_s_ = 0;  ///< Sum of how much less it costs than the present pose.
  double age_s_ = 0;
};

}  // namespace mocap

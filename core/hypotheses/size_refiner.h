// §7.2, beyond the paper: part sizes from many frames at once.
#pragma once

#include <Eigen/Core>

#include "core/body/body_model.h"
#include "core/body/size_jacobian.h"
#include "core/objective/objective.h"

namespace mocap {

/// Accumulates information about a person's sizes over frames. Each frame's residuals are
/// linearised by pose and sizes, the pose is marginalised out, and the rest is summed.
///
/// The prior is centred on the body that was found. The stature may be off by a few percent. Each
/// part varies as it does among people of a stature and build (ANSUR, Gordon et al. 1989). If the
/// body wears a drape, its sizes are refined as well.
class SizeRefiner {
 public:
  /// @param body  the body that was found: the centre of the prior.
  explicit SizeRefiner(const BodyModel& body);

  /// Adds a frame that was fitted well.
  /// @param objective  holds the frame's evidence.
  /// @param worth      how much the frame counts: those close in time err alike.
  void Add(const BodyModel& body, Objective& objective, const PoseState& pose, double worth = 1);
  /// Returns the most likely sizes from all frames so far.
  BodySizes Sizes() const;
  int frames() const { return frames_; }

 private:
  BodySizes start_;
  int count_;  ///< Of the sizes that are refined: the drape only of somebody who wears one.
  SizeJacobian by_size_;
  Eigen::MatrixXd prior_;        ///< Information without any frame.
  Eigen::MatrixXd information_;  ///< Information of the frames.
  Eigen::VectorXd vector_;
  int frames_ = 0;
};

}  // namespace mocap

// §7.2, beyond the paper: part sizes from many frames at once.
#pragma once

#include <Eigen/Core>

#include "core/acquisition/size_jacobian.h"
#include "core/body/body_model.h"
#include "core/tracking/surface_fit.h"

namespace mocap {

/// Gathers what frame after frame tells of a person's sizes: each frame's residuals are linearised
/// by pose and sizes together, the pose is marginalised out, and what remains adds up.
///
/// Its prior is centred on the body that was found. Stature may be off by some percent, and each
/// part differs as far as it does among people of a stature and build (ANSUR, Gordon et al. 1989).
class SizeRefiner {
 public:
  /// @param body  that was found: the centre of the prior.
  explicit SizeRefiner(const BodyModel& body);

  /// Adds a frame that was fitted well.
  /// @param fit  holds the frame's contacts.
  void Add(const BodyModel& body, SurfaceFit& fit, const PoseState& pose);
  /// The likeliest sizes by all frames so far.
  BodySizes Sizes() const;
  int frames() const { return frames_; }

 private:
  BodySizes start_;
  SizeJacobian by_size_;
  Eigen::MatrixXd prior_;        ///< Information without any frame.
  Eigen::MatrixXd information_;  ///< Of the frames.
  Eigen::VectorXd vector_;
  int frames_ = 0;
};

}  // namespace mocap

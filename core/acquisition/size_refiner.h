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
/// Without any frame sizes are as among people: how tall somebody is is open, and parts differ from
/// what is average for the stature as far as they do in a population (ANSUR, Gordon et al. 1989).
class SizeRefiner {
 public:
  /// @param body  its stature is where the search for the person's begins.
  explicit SizeRefiner(const BodyModel& body);

  /// Adds a frame that was fitted well.
  /// @param fit  holds the frame's contacts.
  void Add(const BodyModel& body, SurfaceFit& fit, const PoseState& pose);
  /// The likeliest sizes by all frames so far.
  BodySizes Sizes() const;
  int frames() const { return frames_; }

 private:
  BodySizes average_;
  SizeJacobian by_size_;
  Eigen::MatrixXd prior_;        ///< Information without any frame.
  Eigen::MatrixXd information_;  ///< Of the frames.
  Eigen::VectorXd vector_;
  int frames_ = 0;
};

}  // namespace mocap

// What pose networks say of the person's points, weighed against all other evidence.
#pragma once

#include <span>

#include "core/body/landmarks.h"
#include "core/body/posed_body.h"
#include "core/evidence/keypoint_rays.h"
#include "core/objective/keypoint_noise.h"

namespace mocap {

/// -log p of keypoints. The residual of a keypoint is the distance of the model's point from its
/// line of sight.
///
/// A view is one of three: right, with left and right exchanged, or of something else, which may be
/// anywhere in the person's region. So it costs
///     -log(p_right e^-R + p_exchanged e^-X + p_else e^-E)  nats
/// where R, X and E are the -log p of its points, and a view that is wrong pulls at nothing.
class KeypointTerm {
 public:
  /// @param views  borrowed until the next call.
  void SetEvidence(std::span<const KeypointRays> views) { views_ = views; }

  double At(const PosedBody& posed) const;
  void Linearize(const PosedBody& posed, Linearisation& sums) const;

  /// Adds a view as if it were certainly right.
  /// @param width  factor of the noise: far points pull only if it is wide.
  static void PullAsRight(const KeypointRays& view, double width, const PosedBody& posed,
                          Linearisation& sums);
  /// The probabilities, given a pose, that a view is right, and that it is of something else.
  static double ProbabilityOfRight(const KeypointRays& view, const PosedBody& posed);
  static double ProbabilityOfElsewhere(const KeypointRays& view, const PosedBody& posed);
  /// -log p of one view.
  static double NatsOf(const KeypointRays& view, const PosedBody& posed);

 private:
  std::span<const KeypointRays> views_;
};

}  // namespace mocap

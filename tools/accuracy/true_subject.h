// A simulated person's truth, in the terms of the paper's tracker.
#pragma once

#include <array>
#include <vector>

#include "core/body/body_model.h"
#include "core/evaluation/accuracy.h"
#include "core/mikic2003/limbs.h"
#include "core/mikic2003/orientation.h"

namespace mocap {

/// A person at one moment.
struct TrueSubject {
  double stature_mm = 0;
  ScoredPoints points_W = ScoredPoints::Zero();

  /// Returns one of kScoredPoints.
  Vector3 At(Point point) const;
};

/// Measures the true lengths. Widths and the head are those of an average person of that stature.
BodySizes TrueSizes(const TrueSubject& subject);

/// Fits the paper's body to the true points, in the true orientation alone.
/// @param body  of the paper, with TrueSizes.
mikic2003::OrientedBody TrueStart(const BodyModel& body, const TrueSubject& subject);

/// The parts of a person as capsules around the true bones. The torso's middle axis has one, and
/// both of its sides.
class TrueParts {
 public:
  explicit TrueParts(const TrueSubject& subject);

  /// Finds the part of a point: the one whose bone is nearest, less the part's radius.
  BodyPart PartAt(const Vector3& p_WQ) const;
  /// Directions of the upper arms and thighs away from the torso.
  const std::array<Vector3, mikic2003::kLimbCount>& upper_axes_W() const { return upper_axes_W_; }

 private:
  struct Bone {
    BodyPart part;
    Vector3 from_W, to_W;
    double radius_mm;

    double DistanceTo(const Vector3& p_WQ) const;
  };

  std::vector<Bone> bones_;
  std::array<Vector3, mikic2003::kLimbCount> upper_axes_W_{};
};

}  // namespace mocap

// Rotations of the body's segments, which a result's points alone do not show.
#pragma once

#include <array>
#include <vector>

#include "core/body/body_model.h"
#include "tools/kinematics/rest_body.h"
#include "tools/results/result.h"

namespace mocap {

/// Segments and points of one frame, in the world frame.
struct PosedSegments {
  /// From the reference configuration, where each is the identity; by Segment.
  std::array<Matrix3, kSegmentCount> R_W;
  /// All points [mm]. Those that the row does not have are fixed to the segment before them.
  BodyPlaces places_W;

  const Matrix3& RotationOf(Segment segment) const { return R_W[static_cast<int>(segment)]; }
  /// From a person who stands with hanging arms, where each is the identity.
  Matrix3 RotationFromHanging(Segment segment) const;
};

/// Poses the segments of a body by the rows of its result.
class SegmentPoser {
 public:
  explicit SegmentPoser(const BodyRecord& body);

  const RestBody& rest() const { return rest_; }

  /// Computes the segments' rotations from the joint angles (Mikić et al. 2003, Eqs. 10–12). Then
  /// turns each segment by the shortest rotation to where its bone points, because angles may be
  /// missing, and sizes may have changed since. Angles that a row does not have count as 0. A
  /// segment of which the row has neither all angles nor the points keeps the rotation to its
  /// parent that it has in the reference: of the feet of earlier versions, whose joints had other
  /// axes.
  /// @pre  the row has a pose.
  PosedSegments Pose(const PoseRow& row) const;

 private:
  /// Returns the angles in the order of the body's table; NaN: the row does not have it.
  JointAngles AnglesIn(const PoseRow& row) const;
  bool HasAngles(const JointAngles& theta, Segment segment, Segment parent) const;

  RestBody rest_;
  BodyModel model_;
  std::vector<Eigen::Index> record_place_;  ///< Of each joint in the body's record, by its name.
};

}  // namespace mocap

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
  Vector3 At(Point point) const { return places_W.col(static_cast<int>(point)); }
};

/// Poses the segments of a body by the rows of its result.
class SegmentPoser {
 public:
  explicit SegmentPoser(const BodyRecord& body);

  const RestBody& rest() const { return rest_; }

  /// Computes the segments' rotations from the joint angles (Mikić et al. 2003, Eqs. 10–12). Then
  /// turns each segment by the shortest rotation to where its bone points, because angles may be
  /// missing, and sizes may have changed since. Angles that a row does not have count as 0.
  /// @pre  the row has a pose.
  PosedSegments Pose(const PoseRow& row) const;

 private:
  JointAngles AnglesIn(const PoseRow& row) const;

  RestBody rest_;
  BodyModel model_;
  std::vector<Eigen::Index> record_place_;  ///< Of each joint in the body's record, by its name.
};

}  // namespace mocap

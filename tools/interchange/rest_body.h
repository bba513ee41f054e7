// What the 23 points of a result do not tell: how the body that they are of is built.
#pragma once

#include "core/body/body_sizes.h"
#include "core/body/body_table.h"
#include "tools/results/result.h"

namespace mocap {

/// The points of a row.
inline Vector3 At(const PoseRow& row, Point point) {
  return row.points_W.col(static_cast<int>(point));
}
inline Vector3 HipsMiddle(const PoseRow& row) {
  return (At(row, Point::kHipL) + At(row, Point::kHipR)) / 2;
}
inline Matrix3 TorsoRotation(const PoseRow& row) {
  return ExpRotation(row.paper.torso_axis * row.paper.torso_angle_rad);
}

/// A person at the reference configuration (arms out to the sides, legs down), and what of his
/// build can be told in any pose.
class RestBody {
 public:
  /// @param body  sizes that are none, as of a damaged log, are those of an average person.
  explicit RestBody(const BodyRecord& body);

  const BodySizes& sizes() const { return sizes_; }
  /// The table that the body was tracked with, or else the default.
  const BodyTable& table() const { return table_; }
  /// Points and further joints, p_TQ [mm].
  const BodyPlaces& places_T() const { return places_T_; }
  /// The pelvis' axes in the world: those of the torso unless the waist is turned.
  Matrix3 PelvisRotation(const PoseRow& row) const;
  /// The wrist, on the line from elbow to the middle of the lower arm.
  Vector3 Wrist(const PoseRow& row, Point elbow, Point lower_arm) const;

 private:
  BodyTable table_;
  BodySizes sizes_;
  BodyPlaces places_T_;
  Matrix3 R_rest_;  ///< Axes of hips and spine at the reference configuration.
  double wrist_per_middle_;
};

}  // namespace mocap

// The build of a body, which the 23 points of a result do not contain.
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

/// A person in the reference configuration (arms out to the sides, legs down), with the quantities
/// that follow from the build in any pose.
class RestBody {
 public:
  /// @param body  invalid sizes, as in a damaged log, are replaced by an average person's.
  explicit RestBody(const BodyRecord& body);

  const BodySizes& sizes() const { return sizes_; }
  /// The table with which the body was tracked, or else the default.
  const BodyTable& table() const { return table_; }
  /// Points and additional joints, p_TQ [mm].
  const BodyPlaces& places_T() const { return places_T_; }
  /// The pelvis axes in the world: the torso's unless the waist is turned.
  Matrix3 PelvisRotation(const PoseRow& row) const;

 private:
  BodyTable table_;
  BodySizes sizes_;
  BodyPlaces places_T_;
  Matrix3 R_rest_;  ///< Axes of hips and spine in the reference configuration.
};

}  // namespace mocap

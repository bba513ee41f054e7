// §5: the body as data: a table of rotation axes, the sizes of a person's parts, and the points and
// Jacobians that follow from both by the product of exponentials.
//
// Torso frame T: origin at the torso's centroid, x out of the chest, y to the person's left, z up.
// Reference configuration (all angles 0): legs straight down, arms straight out to the sides.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/body/body_part.h"
#include "core/body/body_shape.h"
#include "core/body/body_sizes.h"
#include "core/body/body_table.h"
#include "core/body/pose_state.h"
#include "core/geometry.h"

namespace mocap {

/// Position of every axis and segment in the world frame, for one pose.
struct Posture {
  RigidTransform X_WT;
  std::array<RigidTransform, kMaxJoints>
      X_W;  ///< M0 Mi1 … Mi: takes reference points carried by the axis to the world.
  std::array<Vector3, kMaxJoints> axis_W;
  std::array<Vector3, kMaxJoints> point_W;  ///< A point on each axis.
};

/// A person's body: a joint table with sizes.
class BodyModel {
 public:
  BodyModel(BodyTable table, const BodySizes& sizes);

  const BodyTable& table() const { return table_; }
  const BodySizes& sizes() const { return sizes_; }
  int joint_count() const { return static_cast<int>(table_.joints.size()); }
  int dof() const { return kTorsoDof + joint_count(); }
  /// Replaces the sizes; the chain stays the same.
  void Resize(const BodySizes& sizes);

  /// All points at the reference configuration, p_TQ; 3 × 37 [mm].
  const BodyPlaces& reference_points_T() const { return reference_points_T_; }
  /// The capsules at the reference configuration.
  const std::vector<Capsule>& shape() const { return shape_; }
  /// Returns the row of the last axis that moves a point; -1 if only the torso moves it.
  int CarrierOf(Point point) const;

  /// Computes the position of every axis for a pose. Eqs. (10)–(12).
  Posture PostureAt(const PoseState& pose) const;
  /// Recomputes some axes of a posture; all others stay.
  /// @param rows  the axes that moved and all axes they carry; parents before children.
  void MoveAxes(const PoseState& pose, std::span<const int> rows, Posture& posture) const;
  /// Places the capsules in the world, in the order of shape(); reuses the memory of `posed`.
  void PoseShape(const Posture& posture, std::vector<PosedCapsule>& posed) const;
  /// Predicts the position of any point [mm].
  Vector3 PlaceOf(Point point, const Posture& posture) const;
  /// Predicts the positions of the 23 points; 3 × 23, column i is p_WQ of point i [mm]. Eq. (13).
  BodyPoints PointsAt(const Posture& posture) const;
  /// Predicts the points that follow the 23, likewise. NaN for those of a hand, a foot or a
  /// shoulder girdle that the table does not move by itself.
  FurtherPoints FurtherPointsAt(const Posture& posture) const;
  /// Differentiates a point by a PoseStep; the point is fixed to the segment that axis `carrier`
  /// moves. Eqs. (17)–(21).
  /// @param p_WQ  current position of the point.
  /// @param J_point_by_step  3 × dof, overwritten [mm/mm, mm/rad].
  void PointJacobian(const Posture& posture, int carrier, const Vector3& p_WQ,
                     Eigen::Ref<Eigen::Matrix<double, 3, Eigen::Dynamic>> J_point_by_step) const;

  /// Differentiates the position of such a point along a direction: one row n^T of PointJacobian,
  /// as a column.
  void DirectionalJacobian(const Posture& posture, int carrier, const Vector3& p_WQ,
                           const Vector3& direction_W, PoseStep& J_by_step) const;

  /// Converts a pose to the paper's 23 numbers; angles that the table lacks are 0. Table 1.
  PaperState PaperStateOf(const PoseState& pose) const;

 private:
  /// Whether the segment of a point that follows the 23 turns against its neighbour.
  bool MovesApart(Point further) const;
  void PlaceAxis(const PoseState& pose, int row, Posture& posture) const;

  BodyTable table_;
  BodySizes sizes_;
  BodyPlaces reference_points_T_;
  std::vector<Capsule> shape_;
  std::array<int, kPlaceCount> point_carrier_{};
};

}  // namespace mocap

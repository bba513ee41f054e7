// §5: the body as data: a table of rotation axes, the sizes of a person's parts, and the points and
// Jacobians that follow from both by the product of exponentials.
//
// Torso frame T: origin at the torso's centroid, x out of the chest, y to the person's left, z up.
// Reference configuration (all angles 0): legs straight down, arms straight out to the sides.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/body/body_part.h"
#include "core/body/pose_state.h"
#include "core/geometry.h"

namespace mocap {

/// One axis of rotation: a row of the body table. A parent stands before its children.
struct JointAxis {
  std::string name;
  int paper_angle = 0;  ///< 1..16 as in Table 1; 0: an axis that the paper's body lacks.
  int parent = -1;      ///< Row of the axis that carries this one; -1: the torso.
  Vector3 axis_T = Vector3::UnitX();  ///< Unit vector, at the reference configuration.
  Point at = Point::kTorso;           ///< The joint that the axis passes through.
  double min_rad = 0, max_rad = 0;
};

/// Segments that are moved as one; the pelvis is a segment of its own where there is a waist.
enum class Segment {
  kTorso = 0,
  kPelvis,
  kHead,
  kUpperArmL,
  kUpperArmR,
  kThighL,
  kThighR,
  kLowerArmL,
  kLowerArmR,
  kCalfL,
  kCalfR
};
inline constexpr int kSegmentCount = 11;

/// The chain: what `--body` chooses. Same code for every table.
struct BodyTable {
  std::string name;
  std::vector<JointAxis> joints;
  std::array<int, kSegmentCount>
      carrier{};  ///< Row of the last axis that moves each segment; -1: the torso itself.
};

/// A person's sizes [mm]: full sizes, the paper's 2λ.
struct BodySizes {
  double torso = 0;  ///< Hip line to neck.
  double torso_width = 0;
  double torso_depth = 0;
  double head = 0;        ///< Chin to vertex.
  double head_width = 0;  ///< Mean of breadth and depth.
  double neck = 0;        ///< Neck joint to the head's centre.
  double upper_arm = 0, lower_arm = 0, thigh = 0,
         calf = 0;  ///< Lower arm to the fingertips, calf to the sole.
  double upper_arm_width = 0, lower_arm_width = 0, thigh_width = 0, calf_width = 0;
  double shoulder_width = 0;  ///< Joint to joint.
  double hip_width = 0;       ///< Joint to joint.

  /// Floor to vertex when standing upright.
  double Stature() const;
};

/// Where a pose puts every axis and segment, in the world frame.
struct Posture {
  RigidTransform X_WT;
  std::array<RigidTransform, kMaxJoints>
      X_W;  ///< M0 Mi1 … Mi: takes reference points carried by the axis to the world.
  std::array<Vector3, kMaxJoints> axis_W;
  std::array<Vector3, kMaxJoints> point_W;  ///< A point on each axis.
};

using BodyPoints = Eigen::Matrix<double, 3, kPointCount>;

/// A person's body: a table with sizes.
class BodyModel {
 public:
  BodyModel(BodyTable table, const BodySizes& sizes);

  const BodyTable& table() const { return table_; }
  const BodySizes& sizes() const { return sizes_; }
  int joint_count() const { return static_cast<int>(table_.joints.size()); }
  int dof() const { return kTorsoDof + joint_count(); }
  /// Takes new sizes; the chain stays.
  void Resize(const BodySizes& sizes);

  /// The 23 points at the reference configuration, p_TQ; 3 × 23 [mm].
  const BodyPoints& reference_points_T() const { return reference_points_T_; }
  /// Row of the last axis that moves a point; -1: only the torso does.
  int CarrierOf(Point point) const;

  /// Puts every axis in its place for a pose. Eqs. (10)–(12).
  Posture PostureAt(const PoseState& pose) const;
  /// Predicts where the 23 points lie; 3 × 23, column i is p_WQ of point i [mm]. Eq. (13).
  BodyPoints PointsAt(const Posture& posture) const;
  /// Differentiates a point fixed to the segment that axis `carrier` moves, by a PoseStep; Eqs.
  /// (17)–(21).
  /// @param p_WQ  where the point is now.
  /// @param J_point_by_step  3 × dof, overwritten [mm/mm, mm/rad].
  void PointJacobian(const Posture& posture, int carrier, const Vector3& p_WQ,
                     Eigen::Ref<Eigen::Matrix<double, 3, Eigen::Dynamic>> J_point_by_step) const;

  /// Reads the paper's 23 numbers off a pose; angles that the table lacks are 0. Table 1.
  PaperState PaperStateOf(const PoseState& pose) const;

 private:
  BodyTable table_;
  BodySizes sizes_;
  BodyPoints reference_points_T_;
  std::array<int, kPointCount> point_carrier_{};
};

}  // namespace mocap

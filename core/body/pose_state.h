// §5, §6: the pose of a body: torso position and orientation, and joint angles. Only this file
// defines the order of the filter's vectors.
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/body/body_part.h"
#include "core/geometry.h"

namespace mocap {

/// Upper limit for the axes of a body table; keeps the filter's matrices off the heap.
inline constexpr int kMaxJoints = 40;
/// Torso translation and rotation come first in every tangent vector.
inline constexpr int kTorsoDof = 6;
inline constexpr int kMaxDof = kTorsoDof + kMaxJoints;

/// A step in the tangent space of a pose: [δt_W (3), δω_W (3), δθ (one per joint)]. δω turns the
/// torso about the axes of the world.
using PoseStep = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxDof, 1>;
using PoseCovariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxDof, kMaxDof>;
using JointAngles = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxJoints, 1>;

/// The paper's 23 numbers: t0, ω0, θ0, θ1..θ16. Table 1.
struct PaperState {
  Vector3 torso_mm = Vector3::Zero();
  Vector3 torso_axis = Vector3::UnitZ();
  double torso_angle_rad = 0;
  std::array<double, kPaperAngleCount> theta_rad{};
};

/// The pose. The torso's rotation is a matrix, and errors live in its tangent space. There is
/// neither a redundant parameter nor a singularity near θ0 = 0.
struct PoseState {
  RigidTransform X_WT;  ///< M0 of Eq. (11).
  JointAngles theta;    ///< [rad], in the order of the body's joint table.

  int dof() const { return kTorsoDof + static_cast<int>(theta.size()); }
  /// Moves the pose by a step in its tangent space.
  void Add(const PoseStep& step);
  /// Returns the step that leads from `from` to this pose; the inverse of Add.
  PoseStep Minus(const PoseState& from) const;
  bool IsFinite() const { return X_WT.p.allFinite() && X_WT.R.allFinite() && theta.allFinite(); }
};

}  // namespace mocap

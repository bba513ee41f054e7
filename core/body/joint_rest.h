// Beyond the paper: rest angles of the joints.
#pragma once

#include "core/body/body_table.h"
#include "core/body/pose_state.h"

namespace mocap {

/// Rest angle of a joint, for one pose.
struct JointRest {
  double rest_rad;
  JointAngles J_by_angle;  ///< Derivative of rest_rad by every joint angle [rad/rad].
};

/// Computes the rest angle of the joint in a row. A collarbone rises with the arm that it carries.
JointRest RestOf(const BodyTable& table, int row, const JointAngles& theta);

/// Computes the chi-square of angles against their rest: the sum over the joints that have one.
double ChiSquareFromRest(const BodyTable& table, const JointAngles& theta);

}  // namespace mocap

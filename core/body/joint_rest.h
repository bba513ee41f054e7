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

/// Computes the rest angle of the joint in a row. A collarbone rises with the arm that it carries
/// (Inman, Saunders, Abbott 1944): true shoulders rise by 0.05 of the stature when hanging arms are
/// raised level. With a girdle that rests level they were 30 mm too high while arms hang, and as
/// much too low with raised arms. It is a prior and no constraint: people can shrug.
JointRest RestOf(const BodyTable& table, int row, const JointAngles& theta);

/// Computes the chi-square of angles against their rest: the sum over the joints that have one.
double ChiSquareFromRest(const BodyTable& table, const JointAngles& theta);

}  // namespace mocap

// Beyond the paper: where joints rest.
#pragma once

#include "core/body/body_table.h"
#include "core/body/pose_state.h"

namespace mocap {

/// Where a joint rests at a pose.
struct JointRest {
  double rest_rad;
  JointAngles J_by_angle;  ///< How that changes with every joint's angle [rad/rad].
};

/// Finds where the joint of a row rests. A collar bone rises with the arm that it carries.
JointRest RestOf(const BodyTable& table, int row, const JointAngles& theta);

}  // namespace mocap

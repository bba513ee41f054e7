// §5: joint angles as a person would describe them, for starting points of a fit.
#pragma once

#include "core/body/body_table.h"
#include "core/body/pose_state.h"

namespace mocap {

/// A stance [degrees]. All zero but for the arms would be: upright, arms straight out to the sides.
struct Stance {
  double raise_l = -75, raise_r = -75;  ///< Arm: -90 hangs, 0 points sideways.
  double forward_l = 0, forward_r = 0;  ///< Arm swung to the front.
  double elbow_l = 15, elbow_r = 15;    ///< Flexion.
  double hip_l = 5, hip_r = 5;          ///< Flexion.
  double knee_l = 10, knee_r = 10;      ///< Flexion.
};

/// The angles of a table's joints in a stance; axes that the paper's body lacks are at rest.
JointAngles AnglesOf(const Stance& stance, const BodyTable& table);

}  // namespace mocap

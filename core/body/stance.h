// §5: joint angles in everyday terms, for the starting points of a fit.
#pragma once

#include "core/body/body_table.h"
#include "core/body/pose_state.h"

namespace mocap {

/// An arm [degrees].
struct ArmStance {
  double raise = -75;  ///< -90: hanging; 0: pointing sideways.
  double forward = 0;  ///< Swing to the front.
  double twist = 0;    ///< Inward rotation about its own axis.
  double elbow = 15;   ///< Flexion.
};

/// A leg [degrees].
struct LegStance {
  double hip = 5;     ///< Flexion.
  double spread = 0;  ///< Outward.
  double knee = 10;   ///< Flexion.
};

/// An upright body with given arms and legs.
struct Stance {
  ArmStance arm_l{}, arm_r{};
  LegStance leg_l{}, leg_r{};
};

/// Computes the joint angles of a stance. Axes that the paper's body lacks are at rest; collarbones
/// follow the elevation of the arms.
JointAngles AnglesOf(const Stance& stance, const BodyTable& table);

}  // namespace mocap

// §5: joint angles as a person would describe them, for starting points of a fit.
#pragma once

#include "core/body/body_table.h"
#include "core/body/pose_state.h"

namespace mocap {

/// An arm [degrees].
struct ArmStance {
  double raise = -75;  ///< -90 hangs, 0 points sideways.
  double forward = 0;  ///< Swung to the front.
  double twist = 0;    ///< Turned in about its own axis.
  double elbow = 15;   ///< Flexion.
};

/// A leg [degrees].
struct LegStance {
  double hip = 5;     ///< Flexion.
  double spread = 0;  ///< Outward.
  double knee = 10;   ///< Flexion.
};

/// A body upright, arms and legs as given.
struct Stance {
  ArmStance arm_l{}, arm_r{};
  LegStance leg_l{}, leg_r{};
};

/// The angles of a table's joints in a stance; axes that the paper's body lacks are at rest, collar
/// bones as high as the arms have them.
JointAngles AnglesOf(const Stance& stance, const BodyTable& table);

}  // namespace mocap

// Joint angles as biomechanics defines them, from the 23 points.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "tools/results/result.h"

namespace mocap {

/// A ball joint with the hinge that it carries: hip and knee, or shoulder and elbow [rad].
struct LimbAngles {
  double flexion = 0;    ///< Forward.
  double adduction = 0;  ///< Towards the body's middle.
  double rotation = 0;   ///< Inwards, about the limb's own axis.
  double bend = 0;       ///< Of knee or elbow.
};

/// Angles with the axes and the order of Rajagopal's model (2016), about z, x and y of axes x
/// forward, y up, z to the right; all 0 of somebody who stands with hanging arms [rad].
struct BodyAngles {
  std::int64_t time_ns = 0;
  Vector3 p_GPelvis;  ///< The pelvis' origin in OpenSim's ground [m].
  Vector3 pelvis;     ///< Tilt, list and rotation in the ground.
  Vector3 lumbar;     ///< Extension, bending and rotation of the torso in the pelvis.
  LimbAngles leg_l, leg_r, arm_l, arm_r;
};

/// Gives the angles of all tracked frames, free of jumps of a whole turn.
///
/// OpenSim's ground is that of TRC: see YUpFromWorld. How a limb is turned about its own axis is
/// read from the plane in which knee or elbow is bent: of a nearly straight limb it fades to 0,
/// because the plane is lost.
std::vector<BodyAngles> AnglesOf(const Result& result);

}  // namespace mocap

// Biomechanical joint angles from the 23 points.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "tools/results/result.h"

namespace mocap {

/// A ball joint and the hinge below it: hip and knee, or shoulder and elbow [rad].
struct LimbAngles {
  double flexion = 0;    ///< Forward.
  double adduction = 0;  ///< Towards the midline.
  double rotation = 0;   ///< Internal, about the limb's own axis.
  double bend = 0;       ///< Of the knee or elbow.
};

/// Angles with axes and order of Rajagopal's model (2016), about z, x and y of axes x forward, y
/// up, z right; all 0 for a person who stands with hanging arms [rad].
struct BodyAngles {
  std::int64_t time_ns = 0;
  Vector3 p_GPelvis;  ///< Pelvis origin in OpenSim's ground [m].
  Vector3 pelvis;     ///< Tilt, list and rotation relative to the ground.
  Vector3 lumbar;     ///< Extension, bending and rotation of the torso relative to the pelvis.
  LimbAngles leg_l, leg_r, arm_l, arm_r;
};

/// The coordinates of Rajagopal's model that BodyAngles has, in the order of the model.
inline constexpr std::array<std::string_view, 22> kCoordinateNames = {
    "pelvis_tilt",    "pelvis_list",      "pelvis_rotation", "hip_flexion_r",   "hip_adduction_r",
    "hip_rotation_r", "knee_angle_r",     "hip_flexion_l",   "hip_adduction_l", "hip_rotation_l",
    "knee_angle_l",   "lumbar_extension", "lumbar_bending",  "lumbar_rotation", "arm_flex_r",
    "arm_add_r",      "arm_rot_r",        "elbow_flex_r",    "arm_flex_l",      "arm_add_l",
    "arm_rot_l",      "elbow_flex_l"};

/// The value of each coordinate [rad].
std::array<double, kCoordinateNames.size()> CoordinatesOf(const BodyAngles& angles);

/// Computes the angles of all tracked frames, without jumps by whole turns.
///
/// OpenSim's ground is that of TRC: see YUpFromWorld. A limb's rotation about its own axis follows
/// from the plane of the bent knee or elbow. For a nearly straight limb this plane is undefined,
/// and the rotation fades to 0.
std::vector<BodyAngles> AnglesOf(const Result& result);

}  // namespace mocap

// Biomechanical joint angles from points and segments.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "tools/kinematics/foot_angles.h"
#include "tools/results/result.h"

namespace mocap {

/// A ball joint and the hinge below it: hip and knee, or shoulder and elbow [rad].
struct LimbAngles {
  double flexion = 0;    ///< Forward.
  double adduction = 0;  ///< Towards the midline.
  double rotation = 0;   ///< Internal, about the limb's own axis.
  double bend = 0;       ///< Of the knee or elbow.
};

/// The hand against the forearm, whose own turn is not measured: the palm is taken to face the way
/// the elbow bends [rad]; NaN: the result does not show the hand.
struct HandAngles {
  double flexion = FootAngles::kUnknown;    ///< Towards the palm.
  double deviation = FootAngles::kUnknown;  ///< Towards the little finger, after the flexion.
  /// As in Plug-in Gait: first the deviation, then away from the palm. The hand's turn about itself
  /// is 0, as it cannot be told from the forearm's.
  Vector3 about_forearm = Vector3::Constant(FootAngles::kUnknown);
};

/// Angles with axes and order of Rajagopal's model (2016), about z, x and y of axes x forward, y
/// up, z right; all 0 for a person who stands with hanging arms [rad].
struct BodyAngles {
  std::int64_t time_ns = 0;
  Vector3 p_GPelvis;  ///< Pelvis origin in OpenSim's ground [m].
  Vector3 pelvis;     ///< Tilt, list and rotation relative to the ground.
  Vector3 lumbar;     ///< Extension, bending and rotation of the torso relative to the pelvis.
  /// Tilt (leaning back), list (to the right) and rotation (turned left) in the walker's frame: x
  /// is the direction of walking; the opposite of it for who walks backward; and where the pelvis
  /// faces for who stands, or goes more than 45 degrees sideways.
  Vector3 walker_pelvis, walker_torso, walker_head;
  LimbAngles leg_l, leg_r, arm_l, arm_r;
  FootAngles foot_l, foot_r;
  HandAngles hand_l, hand_r;
};

/// The coordinates of Rajagopal's model that BodyAngles has, in the order of the model.
inline constexpr std::array<std::string_view, 32> kCoordinateNames = {
    "pelvis_tilt",      "pelvis_list",      "pelvis_rotation", "hip_flexion_r",
    "hip_adduction_r",  "hip_rotation_r",   "knee_angle_r",    "ankle_angle_r",
    "subtalar_angle_r", "mtp_angle_r",      "hip_flexion_l",   "hip_adduction_l",
    "hip_rotation_l",   "knee_angle_l",     "ankle_angle_l",   "subtalar_angle_l",
    "mtp_angle_l",      "lumbar_extension", "lumbar_bending",  "lumbar_rotation",
    "arm_flex_r",       "arm_add_r",        "arm_rot_r",       "elbow_flex_r",
    "wrist_flex_r",     "wrist_dev_r",      "arm_flex_l",      "arm_add_l",
    "arm_rot_l",        "elbow_flex_l",     "wrist_flex_l",    "wrist_dev_l"};

/// The value of each coordinate [rad]; NaN: not known.
std::array<double, kCoordinateNames.size()> CoordinatesOf(const BodyAngles& angles);

/// Computes the angles of all tracked frames, without jumps by whole turns.
///
/// OpenSim's ground is that of TRC: see YUpFromWorld. A leg's rotation about its own axis is that
/// of the tracked thigh, which the foot shows. In results without feet, and for arms, it follows
/// from the plane of the bent knee or elbow. For a nearly straight limb this plane is undefined,
/// and the rotation fades to 0.
std::vector<BodyAngles> AnglesOf(const Result& result);

}  // namespace mocap

#include "tools/interchange/c3d_points.h"

namespace mocap {
namespace {

constexpr double kLeft = -1, kRight = 1;

Vector3 Hip(const LimbAngles& leg) { return {leg.flexion, leg.adduction, leg.rotation}; }

/// Plug-in Gait counts an arm that is lifted to the side as positive.
Vector3 Shoulder(const LimbAngles& arm) { return {arm.flexion, -arm.adduction, arm.rotation}; }

Vector3 Hinge(const LimbAngles& limb) { return {limb.bend, 0, 0}; }

/// Leaning forward, this side raised, this side forward.
Vector3 Leaning(const Vector3& walker_zxy, double side) {
  return {-walker_zxy[0], -side * walker_zxy[1], side * walker_zxy[2]};
}

/// As Leaning, but leaning back.
Vector3 LeaningBack(const Vector3& walker_zxy, double side) {
  return Leaning(walker_zxy, side).cwiseProduct(Vector3(-1, 1, 1));
}

}  // namespace

std::array<Vector3, kC3dAngleNames.size()> C3dAnglesOf(const BodyAngles& angles) {
  return {Hip(angles.leg_l),
          Hip(angles.leg_r),
          Hinge(angles.leg_l),
          Hinge(angles.leg_r),
          Shoulder(angles.arm_l),
          Shoulder(angles.arm_r),
          Hinge(angles.arm_l),
          Hinge(angles.arm_r),
          angles.lumbar,
          angles.foot_l.about_shin,
          angles.foot_r.about_shin,
          angles.hand_l.about_forearm,
          angles.hand_r.about_forearm,
          Leaning(angles.walker_pelvis, kLeft),
          Leaning(angles.walker_pelvis, kRight),
          Leaning(angles.walker_torso, kLeft),
          Leaning(angles.walker_torso, kRight),
          LeaningBack(angles.walker_head, kLeft),
          LeaningBack(angles.walker_head, kRight)};
}

}  // namespace mocap

#include "tools/interchange/c3d_points.h"

namespace mocap {
namespace {

constexpr double kLeft = -1, kRight = 1;

Vector3 Ball(const LimbAngles& limb) { return {limb.flexion, limb.adduction, limb.rotation}; }

Vector3 Hinge(const LimbAngles& limb) { return {limb.bend, 0, 0}; }

Vector3 Ankle(const FootAngles& foot) { return foot.about_shin; }

/// Deviation towards the little finger, extension; the forearm's turn is not known.
Vector3 Wrist(const HandAngles& hand) { return {hand.deviation, -hand.flexion, 0 * hand.flexion}; }

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
  return {Ball(angles.leg_l),
          Ball(angles.leg_r),
          Hinge(angles.leg_l),
          Hinge(angles.leg_r),
          Ball(angles.arm_l),
          Ball(angles.arm_r),
          Hinge(angles.arm_l),
          Hinge(angles.arm_r),
          angles.lumbar,
          Ankle(angles.foot_l),
          Ankle(angles.foot_r),
          Wrist(angles.hand_l),
          Wrist(angles.hand_r),
          Leaning(angles.walker_pelvis, kLeft),
          Leaning(angles.walker_pelvis, kRight),
          Leaning(angles.walker_torso, kLeft),
          Leaning(angles.walker_torso, kRight),
          LeaningBack(angles.walker_head, kLeft),
          LeaningBack(angles.walker_head, kRight)};
}

}  // namespace mocap

// Where bodies of tests stand.
#pragma once

#include <algorithm>
#include <vector>

#include "core/body/posed_body.h"

namespace mocap {

/// Height of the torso's centroid of somebody who stands upright in shoes, whose soles are 20 mm
/// thick [mm].
inline double StandingHeight(const BodySizes& sizes) {
  constexpr double kShoes_mm = 20;
  return sizes.torso / 2 + sizes.thigh + sizes.calf + kShoes_mm;
}

/// Lets somebody stand on the floor: turns the ankles as far as they go until the soles are level,
/// and raises or lowers the body until its lowest flesh touches the floor.
inline void PutOnFloor(const BodyModel& body, PoseState& pose) {
  const std::vector<JointAxis>& joints = body.table().joints;
  double pitch_rad = 0;
  // From hip over knee to ankle, one leg after the other.
  for (int i = 0; i < std::ssize(joints); ++i) {
    const JointAxis& joint = joints[i];
    if (joint.name.starts_with("hip_") && joint.name.ends_with("_y")) pitch_rad = pose.theta[i];
    if (joint.name.starts_with("knee_")) pitch_rad += pose.theta[i];
    if (joint.name.starts_with("ankle_"))
      pose.theta[i] = std::clamp(-pitch_rad, joint.min_rad, joint.max_rad);
  }
  PosedBody posed;
  posed.Set(body, pose);
  double lowest_mm = 1e6;
  for (const PosedCapsule& capsule : posed.capsules()) {
    lowest_mm = std::min(
        {lowest_mm, capsule.a_W.z() - capsule.radius_a_mm, capsule.b_W.z() - capsule.radius_b_mm});
  }
  pose.X_WT.p.z() -= lowest_mm;
}

}  // namespace mocap

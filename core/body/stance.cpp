#include "core/body/stance.h"

#include <algorithm>

#include "core/body/joint_rest.h"
#include "core/degrees.h"

namespace mocap {
namespace {

// Uses the numbers and signs of Table 1.
double DegreesOf(const Stance& stance, int paper_angle) {
  switch (paper_angle) {
    case 3:
      return stance.arm_l.raise;
    case 4:
      return -stance.arm_r.raise;
    case 5:
      return -stance.arm_l.forward;
    case 6:
      return stance.arm_r.forward;
    case 7:
      return stance.arm_l.twist;
    case 8:
      return stance.arm_r.twist;
    case 9:
      return -stance.arm_l.elbow;
    case 10:
      return stance.arm_r.elbow;
    case 11:
      return stance.leg_l.spread;
    case 12:
      return -stance.leg_r.spread;
    case 13:
      return -stance.leg_l.hip;
    case 14:
      return -stance.leg_r.hip;
    case 15:
      return stance.leg_l.knee;
    case 16:
      return stance.leg_r.knee;
    default:
      return 0;
  }
}

}  // namespace

JointAngles AnglesOf(const Stance& stance, const BodyTable& table) {
  JointAngles theta(static_cast<Eigen::Index>(table.joints.size()));
  for (Eigen::Index i = 0; i < theta.size(); ++i) {
    const JointAxis& joint = table.joints[i];
    theta[i] = joint.paper_angle > 0 ? DegreesOf(stance, joint.paper_angle) / kDegreesPerRad
                                     : joint.rest_rad;
  }
  for (int i = 0; i < theta.size(); ++i) {
    const JointAxis& joint = table.joints[i];
    if (joint.rise_rad == 0) continue;
    theta[i] = std::clamp(RestOf(table, i, theta).rest_rad, joint.min_rad, joint.max_rad);
  }
  return theta;
}

}  // namespace mocap

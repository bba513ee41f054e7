#include "core/body/stance.h"

namespace mocap {
namespace {

double DegreesOf(const Stance& stance, int paper_angle) {
  switch (paper_angle) {
    case 3:
      return stance.raise_l;
    case 4:
      return -stance.raise_r;
    case 5:
      return -stance.forward_l;
    case 6:
      return stance.forward_r;
    case 9:
      return -stance.elbow_l;
    case 10:
      return stance.elbow_r;
    case 13:
      return -stance.hip_l;
    case 14:
      return -stance.hip_r;
    case 15:
      return stance.knee_l;
    case 16:
      return stance.knee_r;
    default:
      return 0;
  }
}

}  // namespace

JointAngles AnglesOf(const Stance& stance, const BodyTable& table) {
  JointAngles theta(static_cast<Eigen::Index>(table.joints.size()));
  for (Eigen::Index i = 0; i < theta.size(); ++i) {
    const JointAxis& joint = table.joints[i];
    theta[i] = joint.paper_angle > 0 ? DegreesOf(stance, joint.paper_angle) * EIGEN_PI / 180
                                     : joint.rest_rad;
  }
  return theta;
}

}  // namespace mocap

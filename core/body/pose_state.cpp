#include "core/body/pose_state.h"

namespace mocap {

void PoseState::Add(const PoseStep& step) {
  X_WT.p += step.head<3>();
  X_WT.R = ExpRotation(step.segment<3>(3)) * X_WT.R;
  // Products of many rotations lose orthogonality; a normalized quaternion restores it cheaply.
  X_WT.R = Eigen::Quaterniond(X_WT.R).normalized().toRotationMatrix();
  theta += step.tail(theta.size());
}

PoseStep PoseState::Minus(const PoseState& from) const {
  PoseStep step(dof());
  step.head<3>() = X_WT.p - from.X_WT.p;
  step.segment<3>(3) = LogRotation(X_WT.R * from.X_WT.R.transpose());
  step.tail(theta.size()) = theta - from.theta;
  return step;
}

}  // namespace mocap

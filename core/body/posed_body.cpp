#include "core/body/posed_body.h"

#include <algorithm>

namespace mocap {

void PosedBody::Set(const BodyModel& body, const PoseState& pose) {
  body_ = &body;
  pose_ = pose;
  posture_ = body.PostureAt(pose);
  body.PoseShape(posture_, capsules_);
}

void PosedBody::Move(const PoseState& pose, std::span<const int> rows) {
  pose_ = pose;
  body_->MoveAxes(pose, rows, posture_);
  const std::vector<Capsule>& shape = body_->shape();
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (std::ranges::find(rows, shape[i].carrier) != rows.end())
      capsules_[i] = PosedCapsule(shape[i], posture_.X_W[shape[i].carrier]);
}

}  // namespace mocap

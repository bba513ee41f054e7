#include "tools/stream/streamed_bones.h"

#include "tools/results/message_body.h"
#include "tools/results/pose_log.h"

namespace mocap {

std::optional<HumanoidPose> StreamedBones::Of(const StreamedPose& pose) {
  TakeBody(*pose.body);
  if (!body_ || body_->joint_count() != pose.message.num_joints) return {};
  return HumanoidPoseOf(*body_, StateOf(pose.message));
}

void StreamedBones::TakeBody(const body_t& message) {
  const std::optional<BodyRecord> record = BodyRecordOf(message);
  if (!record) {
    body_.reset();
  } else if (body_ && body_->table().name == record->model && AreSizes(record->sizes)) {
    body_->Resize(record->sizes);
  } else {
    body_ = ModelOf(*record);
  }
}

}  // namespace mocap

// Converts streamed poses to an avatar's bones.
#pragma once

#include <optional>

#include "core/body/body_model.h"
#include "tools/stream/humanoid.h"
#include "tools/stream/pose_feed.h"

namespace mocap {

/// Keeps the body between poses, as its sizes may change.
class StreamedBones {
 public:
  /// Computes the bones of a tracked pose.
  /// @return  empty if the body's table is not built in, or its sizes are implausible.
  std::optional<HumanoidPose> Of(const StreamedPose& pose);

 private:
  void TakeBody(const body_t& message);

  std::optional<BodyModel> body_;
};

}  // namespace mocap

// From poses as they are told to an avatar's bones.
#pragma once

#include <optional>

#include "core/body/body_model.h"
#include "tools/stream/humanoid.h"
#include "tools/stream/pose_feed.h"

namespace mocap {

/// Keeps the body from one pose to the next, whose sizes may be others.
class StreamedBones {
 public:
  /// Reads the bones off a pose that is tracked.
  /// @return  empty where the body's table is not built in, or its sizes are nobody's.
  std::optional<HumanoidPose> Of(const StreamedPose& pose);

 private:
  void TakeBody(const body_t& message);

  std::optional<BodyModel> body_;
};

}  // namespace mocap

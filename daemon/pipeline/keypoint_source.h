// Where the tracker gets keypoints from.
#pragma once

#include <cstdint>
#include <vector>

#include "core/evidence/keypoint_view.h"

namespace mocap {

/// Where keypoints come from.
class KeypointSource {
 public:
  virtual ~KeypointSource() = default;

  /// Moves out what has come since the last call and may count for a set.
  /// @param capture_ns  of the set. @param views  overwritten.
  virtual void TakeFor(std::int64_t capture_ns, std::vector<KeypointView>& views) = 0;
  /// Takes note how well a view agrees with the pose. @param agreement  0 to 1.
  virtual void Tell(const KeypointView& /*view*/, double /*agreement*/) {}
};

}  // namespace mocap

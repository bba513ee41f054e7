// Where a person was in the sets of a take.
#pragma once

#include <optional>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/pose_state.h"

namespace mocap {

/// A person's body, and the pose in each set from the first that shows the person.
struct PersonTrack {
  BodyModel body;
  int first = 0;
  std::vector<std::optional<PoseState>> poses;

  int end() const { return first + static_cast<int>(poses.size()); }
  /// Null: not known.
  const PoseState* At(int set) const {
    if (set < first || set >= end()) return nullptr;
    const std::optional<PoseState>& pose = poses[static_cast<std::size_t>(set - first)];
    return pose ? &*pose : nullptr;
  }
  /// @pre  the sets follow each other.
  void Set(int set, const PoseState& pose) {
    if (poses.empty()) first = set;
    poses.resize(static_cast<std::size_t>(set - first));
    poses.emplace_back(pose);
  }
};

}  // namespace mocap

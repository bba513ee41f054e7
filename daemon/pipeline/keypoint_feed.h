// Brings keypoints to the frame sets that they count for.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/evidence/keypoint_rays.h"
#include "core/people/people_capture.h"
#include "daemon/pipeline/carve_stage.h"
#include "daemon/pipeline/keypoint_source.h"

namespace mocap {

/// Casts keypoints into the room. For one thread.
class KeypointFeed {
 public:
  /// @param source  borrowed; null: there are none.
  KeypointFeed(KeypointSource* source, std::vector<CameraCalibration> cameras)
      : source_(source), cameras_(std::move(cameras)) {}

  /// Returns what has come for a set; valid until the next call. Views of unknown cameras are left
  /// out, and so are those of a moving camera that is not in the set.
  const std::vector<KeypointRays>& For(const CarvedSet& set);
  /// Tells the source how well these views agree with the people.
  void Tell(std::span<const PersonView> people);

 private:
  KeypointSource* source_;
  std::vector<CameraCalibration> cameras_;
  std::vector<KeypointView> views_;
  std::vector<KeypointRays> rays_;
};

}  // namespace mocap

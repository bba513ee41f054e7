// Keypoints of the last moments: cameras are looked at one after the other.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/evidence/keypoint_rays.h"
#include "core/evidence/pose_history.h"
#include "core/evidence/ray_motion.h"

namespace mocap {

/// Keeps views for as long as it is known where the person was.
class RecentKeypoints {
 public:
  void Clear() { views_.clear(); }
  /// Adds the views of a set. @param dt_s  since the set before.
  void Add(std::span<const KeypointRays> views, double dt_s) {
    for (KeypointRays& view : views_) view.after_s -= dt_s;
    std::erase_if(views_, [](const KeypointRays& view) {
      return view.after_s < -1e-9 * PoseHistory::kMemoryNs;
    });
    views_.insert(views_.end(), views.begin(), views.end());
  }
  /// Returns all of them as they would be at the moment of the set.
  std::vector<KeypointRays> AtSet(const PersonMotion& motion) const {
    std::vector<KeypointRays> views = views_;
    for (KeypointRays& view : views) BringToSet(motion, view);
    return views;
  }

 private:
  std::vector<KeypointRays> views_;
};

}  // namespace mocap

// Which keypoints belong over a camera's picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/evidence/keypoint_view.h"

namespace mocap {

/// The newest view of each person of each sender, in pictures of one camera. The page fades them
/// within kKeypointsShownNs of their capture.
class ShownKeypoints {
 public:
  /// Adds a view. It replaces an earlier one of the same sender and person, and one that is so far
  /// ahead that the clock was set back. Views that have faded by then are left out; of too many,
  /// the first.
  void Add(KeypointView view);

  /// KeypointBytes of each view.
  std::string Bytes(int camera) const;

 private:
  static constexpr std::size_t kMostViews = 64;

  std::vector<KeypointView> views_;
};

/// A view is shown for so long after its capture.
inline constexpr std::int64_t kKeypointsShownNs = 1'000'000'000;

}  // namespace mocap

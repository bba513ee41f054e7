#include "tools/view/shown_keypoints.h"

#include <algorithm>
#include <utility>

#include "tools/view/wire.h"

namespace mocap {

void ShownKeypoints::Add(KeypointView view) {
  std::erase_if(views_, [&view](const KeypointView& other) {
    return other.capture_ns < view.capture_ns - kKeypointsShownNs;
  });
  const auto before = std::ranges::find_if(views_, [&view](const KeypointView& other) {
    return other.sender == view.sender && other.person == view.person;
  });
  if (before != views_.end()) {
    const std::int64_t ahead_ns = before->capture_ns - view.capture_ns;
    if (ahead_ns <= 0 || ahead_ns > kKeypointsShownNs) *before = std::move(view);
    return;
  }
  if (views_.size() == kMostViews) views_.erase(views_.begin());
  views_.push_back(std::move(view));
}

std::string ShownKeypoints::Bytes(int camera) const {
  std::string bytes;
  for (const KeypointView& view : views_) bytes += KeypointBytes(view, camera);
  return bytes;
}

}  // namespace mocap

#include "tools/recorded_keypoints.h"

#include <algorithm>
#include <string>

#include "core/errors.h"
#include "drivers/take/keypoint_table.h"

namespace mocap {
namespace {

// Pictures of a set may be this far from its time; without a trigger, half a period at 30 Hz.
constexpr std::int64_t kApartNs = 17'000'000;

}  // namespace

RecordedKeypoints::RecordedKeypoints(const std::filesystem::path& file,
                                     std::span<const std::string> cameras)
    : views_(ReadKeypoints(file)) {
  const auto is_known = [&](const KeypointView& view) {
    return std::ranges::find(cameras, view.camera) != cameras.end();
  };
  if (views_.empty() || std::ranges::any_of(views_, is_known)) return;
  throw SetupError(file.string() + ": has keypoints of " + views_.front().camera +
                   ", which the take does not have; expected keypoints of " + cameras.front());
}

void RecordedKeypoints::TakeFor(std::int64_t capture_ns, std::vector<KeypointView>& views) {
  views.clear();
  while (next_ < views_.size() && views_[next_].capture_ns <= capture_ns + kApartNs)
    views.push_back(views_[next_++]);
}

}  // namespace mocap

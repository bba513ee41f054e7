#include "daemon/pipeline/keypoint_feed.h"

#include <algorithm>
#include <bit>
#include <optional>

namespace mocap {
namespace {

std::optional<RigidTransform> PoseOf(const CameraCalibration& calibration, std::size_t camera,
                                     const CarvedSet& set) {
  if (!(set.cameras >> camera & 1))
    return calibration.head ? std::nullopt : std::optional(calibration.X_CW);
  const std::uint64_t before = set.cameras & ((std::uint64_t{1} << camera) - 1);
  return set.eyes[static_cast<std::size_t>(std::popcount(before))].X_CW;
}

}  // namespace

const std::vector<KeypointRays>& KeypointFeed::For(const CarvedSet& set) {
  rays_.clear();
  if (!source_) return rays_;
  source_->TakeFor(set.capture_ns, views_);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const KeypointView& view = views_[i];
    const auto calibration = std::ranges::find(cameras_, view.camera, &CameraCalibration::name);
    if (calibration == cameras_.end()) continue;
    const auto camera = static_cast<std::size_t>(calibration - cameras_.begin());
    const auto X_CW = PoseOf(*calibration, camera, set);
    if (!X_CW) continue;
    rays_.push_back(
        CastKeypoints(view, static_cast<int>(camera), calibration->lens, *X_CW, set.capture_ns));
    rays_.back().view = static_cast<int>(i);
    if (rays_.back().rays.empty()) rays_.pop_back();
  }
  return rays_;
}

void KeypointFeed::Tell(std::span<const PersonView> people) {
  if (rays_.empty()) return;
  for (const PersonView& person : people)
    for (const KeypointAgreement& told : person.capture->result().agreements)
      source_->Tell(views_[static_cast<std::size_t>(told.view)], told.agreement);
}

}  // namespace mocap

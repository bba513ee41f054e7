#include "daemon/messages/keypoint_message.h"

#include <bitset>
#include <cstdint>
#include <optional>

#include "core/body/landmarks.h"

namespace mocap {
namespace {

/// Later times are invalid.
constexpr std::int64_t kLatestCapture_ns = std::int64_t{1} << 61;
constexpr std::size_t kLongestPointName = 64;

/// Written so that NaN is outside.
bool IsWithin(double value, double least, double most) { return value >= least && value <= most; }

std::optional<Keypoint> KeypointOf(const keypoint_t& point, const CameraCalibration& camera) {
  const bool is_in_picture = IsWithin(point.x_px, -0.5, camera.width_px - 0.5) &&
                             IsWithin(point.y_px, -0.5, camera.height_px - 0.5);
  if (!is_in_picture || !IsWithin(point.score, 0, 1)) return {};
  if (point.name.size() > kLongestPointName) return {};
  const std::optional<Landmark> landmark = LandmarkNamed(point.name);
  if (!landmark) return {};
  return Keypoint{*landmark,
                  {static_cast<float>(point.x_px), static_cast<float>(point.y_px)},
                  static_cast<float>(point.score)};
}

}  // namespace

bool IsSound(const keypoints_t& message) {
  return message.version == keypoints_t::VERSION && !message.sender.empty() &&
         message.capture_ns >= 0 && message.capture_ns < kLatestCapture_ns && message.person >= 0 &&
         message.points.size() <= static_cast<std::size_t>(kMostKeypoints);
}

UsableKeypoints UsableOf(const keypoints_t& message, const CameraCalibration& camera) {
  UsableKeypoints usable;
  usable.view.camera = camera.name;
  usable.view.capture_ns = message.capture_ns;
  usable.view.person = message.person;
  std::bitset<kLandmarkCount> has;
  for (const keypoint_t& point : message.points) {
    const std::optional<Keypoint> keypoint = KeypointOf(point, camera);
    const auto number = keypoint ? static_cast<std::size_t>(keypoint->landmark) : 0;
    if (!keypoint || has[number]) {
      ++usable.dropped;
      continue;
    }
    has[number] = true;
    usable.view.points.push_back(*keypoint);
  }
  return usable;
}

void FillKeypoints(const KeypointView& view, keypoints_t& message) {
  message.version = keypoints_t::VERSION;
  message.camera = view.camera;
  message.capture_ns = view.capture_ns;
  message.person = view.person;
  message.points.clear();
  for (const Keypoint& point : view.points)
    message.points.push_back({NameOf(point.landmark), point.px.x(), point.px.y(), point.score});
  message.num_points = static_cast<std::int32_t>(message.points.size());
}

}  // namespace mocap

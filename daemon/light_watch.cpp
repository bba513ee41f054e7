#include "daemon/light_watch.h"

namespace mocap {
namespace {

/// Statuses that a sudden change may take.
constexpr std::size_t kSudden = 3;
constexpr std::int64_t kNewsNs = 60'000'000'000;

/// The light of each camera; 0 while it does not stream.
std::vector<double> LightOf(const PipelineStatus& status) {
  std::vector<double> light;
  for (const CameraStatus& camera : status.cameras) {
    light.push_back(camera.state == CameraState::kStreaming ? camera.light : 0);
  }
  return light;
}

}  // namespace

std::optional<LightChange> LightWatch::Add(const PipelineStatus& status, std::int64_t now_ns) {
  const std::vector<double> light = LightOf(status);
  LightChange found;
  found.time_ns = now_ns;
  for (std::size_t i = 0; !past_.empty() && i < light.size(); ++i) {
    const double before = past_.front()[i];
    if (before <= 0 || light[i] <= 0) continue;
    const double factor = light[i] / before;
    if (factor < kSuddenFactor && factor > 1 / kSuddenFactor) continue;
    if (found.cameras.empty()) found.factor = factor;
    found.cameras.push_back(status.cameras[i].name);
  }
  past_.push_back(light);
  if (past_.size() > kSudden) past_.pop_front();
  if (!found.cameras.empty()) {
    change_ = found;
    past_.clear();
  }
  if (change_ && now_ns - change_->time_ns > kNewsNs) change_.reset();
  return change_;
}

}  // namespace mocap

#include "daemon/status/light_watch.h"

namespace mocap {
namespace {

/// Statuses that a sudden change may span.
constexpr std::size_t kSudden = 3;
constexpr std::int64_t kNewsNs = 60'000'000'000;

}  // namespace

std::vector<LightWatch::Seen> LightWatch::SeenIn(const PipelineStatus& status) {
  std::vector<Seen> seen;
  for (const CameraStatus& camera : status.cameras) {
    const bool streams = camera.state == CameraState::kStreaming;
    seen.push_back({streams ? camera.light : 0, camera.replacements});
  }
  return seen;
}

std::optional<LightChange> LightWatch::Add(const PipelineStatus& status, std::int64_t now_ns) {
  const std::vector<Seen> now = SeenIn(status);
  LightChange found;
  found.time_ns = now_ns;
  for (std::size_t i = 0; !past_.empty() && i < now.size(); ++i) {
    const Seen& before = past_.front()[i];
    if (before.light <= 0 || now[i].light <= 0) continue;
    if (before.replacements != now[i].replacements) continue;
    const double factor = now[i].light / before.light;
    if (factor < kSuddenFactor && factor > 1 / kSuddenFactor) continue;
    if (found.cameras.empty()) found.factor = factor;
    found.cameras.push_back(status.cameras[i].name);
  }
  past_.push_back(now);
  if (past_.size() > kSudden) past_.pop_front();
  if (!found.cameras.empty()) {
    change_ = found;
    past_.clear();
  }
  if (change_ && now_ns - change_->time_ns > kNewsNs) change_.reset();
  return change_;
}

}  // namespace mocap

#include "daemon/service/change_log.h"

#include <spdlog/spdlog.h>

namespace mocap {

void ChangeLog::Add(const PipelineStatus& status) {
  const PipelineStatus before = last_.value_or(PipelineStatus{});
  if (!last_ || status.state != before.state) {
    spdlog::info("{}", kCaptureStateNames[static_cast<std::size_t>(status.state)]);
  }
  if (last_) CompareCameras(before, status);
  for (const CameraStatus& camera : status.cameras) TellRemarks(camera);
  const bool was_behind = calls_since_drop_ < kCallsToRecover;
  const bool drops = status.sets_dropped > before.sets_dropped;
  calls_since_drop_ = drops ? 0 : calls_since_drop_ + 1;
  if (drops && !was_behind) spdlog::warn("tracking is behind: the stalest sets are dropped");
  if (was_behind && calls_since_drop_ == kCallsToRecover) spdlog::info("tracking keeps up again");
  last_ = status;
}

void ChangeLog::TellRemarks(const CameraStatus& camera) {
  for (const std::string& remark : camera.remarks) {
    const std::string line = camera.name + ": " + remark;
    if (told_.insert(line).second) spdlog::warn("{}", line);
  }
}

void ChangeLog::CompareCameras(const PipelineStatus& before, const PipelineStatus& now) {
  for (std::size_t i = 0; i < now.cameras.size(); ++i) {
    const CameraState then = before.cameras[i].state;
    const CameraStatus& camera = now.cameras[i];
    if (camera.state == then) continue;
    if (camera.state == CameraState::kLost) spdlog::warn("{} is lost", camera.name);
    if (camera.state == CameraState::kEnded) spdlog::info("{} has ended", camera.name);
    if (camera.state == CameraState::kStreaming) {
      spdlog::info("{} {}", camera.name,
                   then == CameraState::kLost ? "is back" : "delivers frames");
    }
  }
}

}  // namespace mocap

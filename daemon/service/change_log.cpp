#include "daemon/service/change_log.h"

#include <spdlog/spdlog.h>

namespace mocap {
namespace {

/// A remark with a counter is the same remark when only the number changed.
std::string WithoutDigits(std::string text) {
  std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
  return text;
}

}  // namespace

void ChangeLog::Add(const PipelineStatus& status) {
  const PipelineStatus before = last_.value_or(PipelineStatus{});
  if (status.tracks && (!last_ || status.state != before.state)) {
    spdlog::info("{}", kCaptureStateNames[static_cast<std::size_t>(status.state)]);
  }
  if (last_) CompareCameras(before, status);
  for (const CameraStatus& camera : status.cameras) TellRemarks(camera);
  const bool was_behind = calls_since_drop_ < kCallsToRecover;
  const bool drops = status.sets_dropped > before.sets_dropped;
  calls_since_drop_ = drops ? 0 : calls_since_drop_ + 1;
  if (drops && !was_behind) spdlog::warn("tracking is behind: the oldest frame sets are dropped");
  if (was_behind && calls_since_drop_ == kCallsToRecover) spdlog::info("tracking has caught up");
  last_ = status;
}

void ChangeLog::TellRemarks(const CameraStatus& camera) {
  for (const std::string& remark : camera.remarks) {
    if (!told_.insert(camera.name + ": " + WithoutDigits(remark)).second) continue;
    spdlog::warn("{}: {}", camera.name, remark);
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

#include "daemon/service/change_log.h"

#include <spdlog/spdlog.h>

#include "daemon/status/camera_diagnostics.h"

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
  std::vector<std::string> lost, ended, back, first;
  for (std::size_t i = 0; i < now.cameras.size(); ++i) {
    const CameraState then = before.cameras[i].state;
    const CameraStatus& camera = now.cameras[i];
    if (camera.state == then) continue;
    if (camera.state == CameraState::kLost) lost.push_back(camera.name);
    if (camera.state == CameraState::kEnded) ended.push_back(camera.name);
    if (camera.state == CameraState::kStreaming)
      (then == CameraState::kLost ? back : first).push_back(camera.name);
  }
  const auto all = now.cameras.size();
  if (!lost.empty()) spdlog::warn(CamerasDo(lost, all, "is lost", "are lost"));
  if (!back.empty()) spdlog::info(CamerasDo(back, all, "is back", "are back"));
  if (!first.empty()) spdlog::info(CamerasDo(first, all, "delivers frames", "deliver frames"));
  if (!ended.empty()) spdlog::info(CamerasDo(ended, all, "has ended", "have ended"));
}

}  // namespace mocap

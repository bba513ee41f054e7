#include "daemon/service/live_config.h"

#include <fmt/ranges.h>

#include "config/config_changes.h"
#include "config/load_config.h"
#include "core/errors.h"
#include "daemon/service/service_setup.h"

namespace mocap {
namespace {

/// Keys that do not affect the frame path.
bool CanChangeLive(const std::string& key) {
  return key == "lcm.voxels_hz" || key.starts_with("metrics.") || key.starts_with("recording.");
}

void TakeOver(const Config& from, Config& to) {
  to.lcm.voxels_hz = from.lcm.voxels_hz;
  to.service.metrics = from.service.metrics;
  to.service.recording = from.service.recording;
}

}  // namespace

LiveConfig::LiveConfig(const std::optional<std::filesystem::path>& file) : file_(file) {
  if (!file_) return;
  config_ = LoadConfig(*file_);
  started_with_ = last_read_ = ReadConfigText(*file_);
}

ReloadResult LiveConfig::Reload() {
  if (!file_)
    throw SetupError("mocapd was started without a configuration file; there is nothing to reload");
  const Config next = LoadConfig(*file_);
  RequirePlaces(next);
  const std::string text = ReadConfigText(*file_);
  ReloadResult result;
  for (const std::string& key : ChangedKeys(last_read_, text)) {
    if (CanChangeLive(key)) result.applied.push_back(key);
  }
  for (const std::string& key : ChangedKeys(started_with_, text)) {
    if (!CanChangeLive(key)) result.need_restart.push_back(key);
  }
  TakeOver(next, config_);
  last_read_ = text;
  return result;
}

std::string ReloadText(const ReloadResult& result) {
  std::string text;
  if (!result.applied.empty()) {
    text = fmt::format("applied {}", fmt::join(result.applied, ", "));
  }
  if (!result.need_restart.empty()) {
    text += fmt::format("{}{} need{} a restart", text.empty() ? "" : "; ",
                        fmt::join(result.need_restart, ", "),
                        result.need_restart.size() == 1 ? "s" : "");
  }
  return text.empty() ? "nothing has changed" : text;
}

}  // namespace mocap

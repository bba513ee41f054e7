// The configuration of a running daemon, and which changes it can apply without interruption.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"

namespace mocap {

/// Result of reading the configuration again.
struct ReloadResult {
  std::vector<std::string> applied;       ///< Keys that changed and are now in force.
  std::vector<std::string> need_restart;  ///< Keys that differ from those in force.
};

/// Keeps the configuration that the daemon was started with. Thread-bound.
class LiveConfig {
 public:
  /// @param file  none: the defaults, which cannot be reloaded. @throws SetupError
  explicit LiveConfig(const std::optional<std::filesystem::path>& file);

  /// The configuration in force.
  const Config& config() const { return config_; }
  /// The text of the file as read at the start.
  const std::string& text() const { return started_with_; }

  /// Reads the file again and applies what can change while frames flow; the rest of config()
  /// stays. @throws SetupError  for an invalid file; then nothing has changed.
  ReloadResult Reload();

 private:
  std::optional<std::filesystem::path> file_;
  Config config_;
  std::string started_with_;
  std::string last_read_;
};

/// "lcm.voxels_hz now holds; voxels.size_mm needs a restart".
std::string ReloadText(const ReloadResult& result);

}  // namespace mocap

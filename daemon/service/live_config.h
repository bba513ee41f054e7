// The configuration of a running daemon, and what of a new one can be taken over without a gap.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"

namespace mocap {

/// Outcome of reading the configuration again.
struct ReloadResult {
  std::vector<std::string> applied;       ///< Keys that changed and now hold.
  std::vector<std::string> need_restart;  ///< Keys that differ from what the daemon runs with.
};

/// Remembers what the daemon was started with. Thread-bound.
class LiveConfig {
 public:
  /// @param file  none: the defaults, which cannot be reloaded. @throws SetupError
  explicit LiveConfig(const std::optional<std::filesystem::path>& file);

  /// The configuration in force.
  const Config& config() const { return config_; }
  /// The file's text as it was read at the start.
  const std::string& text() const { return started_with_; }

  /// Reads the file again and takes over what can be changed while frames flow; the rest of
  /// config() stays as it was. @throws SetupError  for a file that is wrong; nothing has changed
  /// then.
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

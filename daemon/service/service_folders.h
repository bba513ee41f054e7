// Where the daemon keeps what it has to keep.
#pragma once

#include <filesystem>

namespace mocap {

/// The folder for state: systemd's STATE_DIRECTORY, else mocapd in XDG_STATE_HOME or in
/// ~/.local/state, else here.
std::filesystem::path StateFolder();

/// The folder for logs: systemd's LOGS_DIRECTORY; empty elsewhere.
std::filesystem::path LogsFolder();

}  // namespace mocap

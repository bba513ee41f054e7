// Where the daemon keeps what it has to keep.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace mocap {

/// The folder for state: systemd's STATE_DIRECTORY, else mocapd in XDG_STATE_HOME or in
/// ~/.local/state, else here.
std::filesystem::path StateFolder();

/// The folder for logs: systemd's LOGS_DIRECTORY; empty elsewhere.
std::filesystem::path LogsFolder();

/// When a file was written last, since the Unix epoch [s]; 0 where there is none.
std::int64_t WrittenAt(const std::filesystem::path& file);

/// Why no file can be made in a folder, or in the folder that it would be made in; empty: it can,
/// or could if there were room. Leaves nothing there.
std::string WhyNotWritable(const std::filesystem::path& folder);

}  // namespace mocap

// Folders in which the daemon keeps its files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace mocap {

/// The folder for state: systemd's STATE_DIRECTORY, else mocapd in XDG_STATE_HOME or in
/// ~/.local/state, else the current folder.
std::filesystem::path StateFolder();

/// The folder for logs: systemd's LOGS_DIRECTORY, else empty.
std::filesystem::path LogsFolder();

/// Time of the last write to a file, since the Unix epoch [s]; 0 if there is no such file.
std::int64_t WrittenAt(const std::filesystem::path& file);

/// The reason why no file can be created in a folder, or in its nearest existing parent. Empty if
/// one can be created, or only space is lacking. Leaves no file behind.
std::string WhyNotWritable(const std::filesystem::path& folder);

}  // namespace mocap

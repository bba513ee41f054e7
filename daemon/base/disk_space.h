// Free disk space for takes.
#pragma once

#include <cstdint>
#include <filesystem>

namespace mocap {

/// Returns the folder itself, or its nearest parent that exists and is visible.
std::filesystem::path NearestFolder(const std::filesystem::path& folder);

/// Bytes that the daemon's user may still write in a folder, or in the nearest existing parent of
/// one not made yet. 0 if unknown.
std::int64_t BytesFree(const std::filesystem::path& folder);

}  // namespace mocap

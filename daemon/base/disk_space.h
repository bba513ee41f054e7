// How much room there is for takes.
#pragma once

#include <cstdint>
#include <filesystem>

namespace mocap {

/// Gives a folder, or the nearest above it that is there and may be seen.
std::filesystem::path NearestFolder(const std::filesystem::path& folder);

/// Bytes that the daemon's user may still write where a folder is, or would be made; 0 where nobody
/// can tell.
std::int64_t BytesFree(const std::filesystem::path& folder);

}  // namespace mocap

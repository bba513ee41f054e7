// Disk space for takes.
#pragma once

#include <cstdint>
#include <filesystem>

namespace mocap {

/// Returns the folder itself, or its nearest parent that exists and is visible.
std::filesystem::path NearestFolder(const std::filesystem::path& folder);

/// Checks that a folder in which files are being written was not taken away: writing would not
/// fail.
/// @throws std::runtime_error  naming it, and the nearest folder that still exists.
void RequireStillThere(const std::filesystem::path& folder);

/// Bytes that the daemon's user may still write in a folder, or in the nearest existing parent of
/// one not made yet. 0 if unknown.
std::int64_t BytesFree(const std::filesystem::path& folder);

/// Bytes of all files in a folder and its subfolders; those that cannot be read are left out.
std::int64_t BytesIn(const std::filesystem::path& folder);

}  // namespace mocap

// Opens files and folders named by a user, or explains in one line why that fails.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace mocap {

/// Whether a path exists. @throws SetupError  when that cannot be determined, as without permission
/// for its folder.
bool IsThere(const std::filesystem::path& path);

/// Checks that a file can be read.
/// @param wanted  the expected kind of file, such as "a TOML file".
/// @throws SetupError  stating whether it is missing, is a folder or may not be read.
void RequireFile(const std::filesystem::path& file, std::string_view wanted);

/// Checks that a folder exists. @throws SetupError  as RequireFile.
void RequireFolder(const std::filesystem::path& folder, std::string_view wanted);

/// Opens a file for reading. @return  a descriptor that the caller owns. @throws as RequireFile.
int OpenToRead(const std::filesystem::path& file, std::string_view wanted);

/// Reads a whole file. @throws SetupError  as RequireFile, and if it is larger than `most_bytes`.
std::string ReadWholeFile(const std::filesystem::path& file, std::string_view wanted,
                          std::size_t most_bytes);

/// Returns a folder without `/`, `.` or resolvable `..` at its end.
std::filesystem::path PlainFolder(const std::filesystem::path& folder);

}  // namespace mocap

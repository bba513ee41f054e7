// Files and folders that somebody names: opened, or told in one line why they cannot be.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace mocap {

/// Whether something is there. @throws SetupError  where that cannot be found out, as without
/// permission for its folder.
bool IsThere(const std::filesystem::path& path);

/// Makes sure that a file can be read.
/// @param wanted  what it shall be, as in "a TOML file".
/// @throws SetupError  saying whether it is missing, is a folder or may not be read.
void RequireFile(const std::filesystem::path& file, std::string_view wanted);

/// Makes sure that a folder is there. @throws SetupError  as RequireFile.
void RequireFolder(const std::filesystem::path& folder, std::string_view wanted);

/// Opens a file for reading. @return  a descriptor, which is the caller's. @throws as RequireFile.
int OpenToRead(const std::filesystem::path& file, std::string_view wanted);

/// Reads a whole file. @throws SetupError  as RequireFile, and for one that is larger.
std::string ReadWholeFile(const std::filesystem::path& file, std::string_view wanted,
                          std::size_t most_bytes);

/// The folder as its own name says it: without `/`, `.` or what `..` undoes at its end.
std::filesystem::path PlainFolder(const std::filesystem::path& folder);

}  // namespace mocap

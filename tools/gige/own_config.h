// A configuration that the program wrote, and that nobody has changed since.
#pragma once

#include <filesystem>
#include <string>

namespace mocap {

/// Puts a first line before a configuration that tells who wrote it, with a checksum of the rest.
std::string SignedConfig(const std::string& text);

/// Makes sure that writing a configuration takes nothing from anybody: there is no such file, it is
/// empty, or it is as SignedConfig made it.
/// @throws SetupError  naming the file.
void RequireOwnConfig(const std::filesystem::path& file);

}  // namespace mocap

// Configurations written by the program and not changed since.
#pragma once

#include <filesystem>
#include <string>

namespace mocap {

/// Adds a first line to a configuration, with its author and a checksum of the rest.
std::string SignedConfig(const std::string& text);

/// Checks that writing a configuration loses nobody's data: the file is missing, empty, or
/// unchanged since SignedConfig.
/// @throws SetupError  naming the file.
void RequireOwnConfig(const std::filesystem::path& file);

}  // namespace mocap

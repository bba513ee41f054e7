// Differences between two versions of the daemon's configuration.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mocap {

/// Reads the text of a configuration file. @throws SetupError  if it cannot be read.
std::string ReadConfigText(const std::filesystem::path& file);

/// Lists the keys, such as "voxels.size_mm", whose values differ or that only one text has, sorted.
/// An array of tables counts as one key. @throws SetupError  if either is not TOML.
std::vector<std::string> ChangedKeys(const std::string& before, const std::string& after);

}  // namespace mocap

// Differences between two versions of the daemon's configuration.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mocap {

/// The text of a configuration file. @throws SetupError  when it cannot be read.
std::string ReadConfigText(const std::filesystem::path& file);

/// Names the keys, as in "voxels.size_mm", whose values differ or that only one text has, sorted.
/// An array of tables counts as one key. @throws SetupError  when either is no TOML.
std::vector<std::string> ChangedKeys(const std::string& before, const std::string& after);

}  // namespace mocap

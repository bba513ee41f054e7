// Finds takes that earlier runs of the daemon could not complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mocap {

/// A take whose recording ended when the daemon died.
struct CutOffTake {
  std::filesystem::path folder;  ///< Its name ends in .partial.
  std::int64_t duration_ns = 0;
  std::int64_t last_ns = 0;  ///< Capture time of its last frame.
};

/// Finds them in the folder of takes, sorted by name. Damaged ones are omitted.
std::vector<CutOffTake> FindCutOffTakes(const std::filesystem::path& takes);

}  // namespace mocap

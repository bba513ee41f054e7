// Takes that earlier runs of the daemon could not complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mocap {

/// A take whose recording ended with the daemon's life.
struct CutOffTake {
  std::filesystem::path folder;  ///< Its name ends in .partial.
  std::int64_t duration_ns = 0;
  std::int64_t last_ns = 0;  ///< Capture of its last frame.
};

/// Finds them in the folder of takes, in the order of their names; damaged ones are left out.
std::vector<CutOffTake> FindCutOffTakes(const std::filesystem::path& takes);

}  // namespace mocap

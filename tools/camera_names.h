// Detects recordings whose names are swapped.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "tools/take_samples.h"

namespace mocap {

using CameraPair = std::pair<std::string, std::string>;

/// Finds the two cameras whose calibrations must be swapped for all cameras to see one person.
/// @return  empty if the cameras agree as they are, or no swap makes them agree.
std::optional<CameraPair> FindSwappedCameras(const TakeSamples& samples);

/// Describes the swap and the remedy.
std::string SwappedText(const CameraPair& swapped);

}  // namespace mocap

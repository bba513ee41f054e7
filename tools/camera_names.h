// Finds recordings that go by each other's name.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "tools/take_samples.h"

namespace mocap {

using CameraPair = std::pair<std::string, std::string>;

/// Tells which two cameras' calibrations have to be exchanged for all cameras to see one person.
/// @return  nothing where the cameras agree as they are, or no exchange makes them agree.
std::optional<CameraPair> FindSwappedCameras(const TakeSamples& samples);

/// Says so, and what to do.
std::string SwappedText(const CameraPair& swapped);

}  // namespace mocap

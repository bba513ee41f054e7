// Calibration on disk: what a recording puts beside its videos.
#pragma once

#include <filesystem>
#include <span>

#include "core/reconstruction/camera_model.h"

namespace mocap {

/// Writes calibration.toml, every number with all its digits.
/// @throws std::runtime_error  when the file cannot be written.
void WriteCalibration(const std::filesystem::path& file,
                      std::span<const CameraCalibration> cameras);

}  // namespace mocap

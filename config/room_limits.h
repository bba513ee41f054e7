// Checks the room that cameras look at: its voxels must fit into memory.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/reconstruction/camera/camera_model.h"
#include "drivers/studio.h"

namespace mocap {

/// Checks that calibrated cameras can carve a room with voxels of this size.
/// @param where  the calibration's file, for messages.
/// @throws SetupError  for an implausible room, such as from a calibration in metres, and for more
/// voxels than the memory limit permits.
void RequireRoom(std::span<const CameraCalibration> cameras, double voxel_mm,
                 const std::string& where);

/// Adds a remark for each camera of a calibration that cannot stand where it says.
/// @param cameras  all of the file, also those that are not used here.
void RemarkOnPlaces(std::span<const CameraCalibration> cameras, const std::filesystem::path& file,
                    Studio& studio);

}  // namespace mocap

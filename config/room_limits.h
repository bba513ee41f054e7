// Limits the size of the room: its voxels must fit into memory.
#pragma once

#include <span>
#include <string>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Checks that calibrated cameras can carve a room with voxels of this size.
/// @param where  the calibration's file, for messages.
/// @throws SetupError  for an implausible room, such as from a calibration in metres, and for more
/// voxels than the memory limit permits.
void RequireRoom(std::span<const CameraCalibration> cameras, double voxel_mm,
                 const std::string& where);

}  // namespace mocap

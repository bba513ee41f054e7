// How large a room the cameras may look at: what is carved has to fit into memory.
#pragma once

#include <span>
#include <string>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Makes sure that calibrated cameras can carve a room in voxels of a size.
/// @param where  the calibration's file, for messages.
/// @throws SetupError  for a room that no studio has, as of a calibration in metres, and for more
/// voxels than memory is spent on.
void RequireRoom(std::span<const CameraCalibration> cameras, double voxel_mm,
                 const std::string& where);

}  // namespace mocap

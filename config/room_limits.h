// Checks the room that a studio's cameras look at: its voxels must fit into memory.
#pragma once

#include <string>

#include "drivers/studio.h"

namespace mocap {

/// Checks that a studio's calibrated cameras can carve a room with voxels of this size. Adds a
/// remark for each place of a camera that is implausible.
/// @param where  the calibration's file, for messages.
/// @throws SetupError  for an implausible room, such as from a calibration in metres, and for more
/// voxels than the memory limit permits.
void CheckRoom(Studio& studio, double voxel_mm, const std::string& where);

}  // namespace mocap

// C3D files, in which biomechanics exchanges motion.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes the 23 points in millimetres in the world's frame (z up, which X_SCREEN and Y_SCREEN
/// tell), and joint angles in degrees as points of the type ANGLES; floats in Intel's byte order.
/// The file has one rate: frames that are missing are filled in. A point of somebody who is not
/// tracked has the residual -1. EVENT tells where tracking starts and ends.
/// @throws SetupError  as RequireShortGap, and for more people than labels fit of.
ExportRemarks WriteC3d(const ExportScene& scene, std::ostream& out);

}  // namespace mocap

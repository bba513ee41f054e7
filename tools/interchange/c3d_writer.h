// C3D files, the exchange format of biomechanics.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes the 23 points and kC3dMarkers in millimetres in the world frame (z up, as X_SCREEN and
/// Y_SCREEN state), and joint angles in degrees as points of type ANGLES; floats, little-endian.
/// The file has a constant rate: missing frames are filled in. Points of people who are not
/// tracked, and what a result does not know, have the residual -1. EVENT has the start and end of
/// tracking, and foot strikes and toe-offs.
/// @throws SetupError  as RequireShortGap, and for more people than labels allow.
ExportRemarks WriteC3d(const ExportScene& scene, std::ostream& out);

}  // namespace mocap

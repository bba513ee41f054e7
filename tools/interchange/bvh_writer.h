// Biovision's hierarchy files.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes a motion in centimetres and degrees, y up (see YUpFromWorld). Rotations are in the order
/// Z, X, Y, without jumps between frames. The file begins with the first tracked frame. With
/// several people it begins with their first moment, in this person's first tracked pose. Gaps hold
/// the last pose.
/// @pre  the scene has one subject.
/// @throws SetupError  as MakeSkeletonMotion.
ExportRemarks WriteBvh(const ExportScene& scene, std::ostream& out);

}  // namespace mocap

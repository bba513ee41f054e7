// Biovision's hierarchy files.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes a motion in centimetres and degrees, y up (see YUpFromWorld); rotations in the order Z,
/// X, Y, free of jumps from frame to frame. It begins with the first tracked frame or, of several
/// people, with their first moment and the pose in which this one is tracked first. In gaps the
/// last pose is held.
/// @pre  the scene has one subject.
/// @throws SetupError  as MakeSkeletonMotion.
ExportRemarks WriteBvh(const ExportScene& scene, std::ostream& out);

}  // namespace mocap

// Binary glTF 2.0: a person's body that moves.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes the measured body as a skinned mesh, with one node a joint and an animation, in metres, y
/// up (see YUpFromWorld). Times are those of capture since the scene's first moment. In gaps the
/// last pose is held. Bones that change their length, as they do until sizes have settled, move
/// their joints.
/// @pre  the scene has one subject.
/// @throws SetupError  as MakeSkeletonMotion.
ExportRemarks WriteGlb(const ExportScene& scene, std::ostream& out);

}  // namespace mocap

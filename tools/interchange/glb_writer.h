// Binary glTF 2.0: an animated body.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes the measured body as a skinned mesh with one node per joint and an animation; metres, y
/// up (see YUpFromWorld). Times are capture times since the scene's first moment. Gaps hold the
/// last pose. Bones change their length until sizes have settled; then joints move.
/// @pre  the scene has one subject.
/// @throws SetupError  as MakeSkeletonMotion.
ExportRemarks WriteGlb(const ExportScene& scene, std::ostream& out);

}  // namespace mocap

// §7.1, §7.3: the poses in which a body that was just located may stand, before the voxels have
// their say.
#pragma once

#include <vector>

#include "core/acquisition/body_localizer.h"
#include "core/body/body_model.h"

namespace mocap {

/// Poses that put the body's neck and torso where they were located: each of a few everyday
/// postures, facing all around. Left and right are thereby open: for each pose there is one that
/// faces the other way.
std::vector<PoseState> PoseHypotheses(const BodyModel& body, const LocalizedBody& located);

}  // namespace mocap

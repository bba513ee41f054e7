// A person's sizes from a whole take.
#pragma once

#include <span>

#include "core/solving/person_evidence.h"
#include "core/solving/pose_path.h"

namespace mocap {

/// Measures a person in sets spread over a path, each time from the poses that the new sizes lead
/// to. Live, sizes are those of the first three seconds.
/// @param first  set of the path's first step.
/// @return  the sizes of the track where the path has no poses.
BodySizes MeasureOver(RecordedSets& sets, int first, std::span<const PathStep> path,
                      PersonEvidence& evidence);

/// The things that a person wears or carries in most of a path's sets.
Things ThingsOf(std::span<const PathStep> path);

}  // namespace mocap

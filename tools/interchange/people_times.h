// One clock for the results of several people, so that what is exported of each goes together.
#pragma once

#include <vector>

#include "tools/results/result.h"

namespace mocap {

/// Frames and times of all who were tracked together, in order; nothing else of the rows is set.
std::vector<PoseRow> MomentsOf(const PeopleResults& people);

/// A result that begins with the first of the moments: until he is tracked, it has the pose in
/// which he is tracked first. For formats that know no time but that since their beginning.
/// @pre  he is tracked at some time.
Result HoldingFirstPose(const Result& result, const std::vector<PoseRow>& moments);

/// How long the first of the moments lies before the first tracked frame of somebody [s].
/// @pre  he is tracked at some time.
double SecondsBeforeFirstPose(const Result& result, const std::vector<PoseRow>& moments);

}  // namespace mocap

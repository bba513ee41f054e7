// A common clock for the results of several people, so that their exports match.
#pragma once

#include <vector>

#include "tools/results/result.h"

namespace mocap {

/// Frames and times of all people tracked together, in order; other fields of the rows are not set.
std::vector<PoseRow> MomentsOf(const PeopleResults& people);

/// A result that begins with the first moment. Until the person is tracked, it has the first
/// tracked pose. For formats whose time starts at the beginning of the file.
/// @pre  the person is tracked at some time.
Result HoldingFirstPose(const Result& result, const std::vector<PoseRow>& moments);

/// Time from the first moment to a person's first tracked frame [s].
/// @pre  the person is tracked at some time.
double SecondsBeforeFirstPose(const Result& result, const std::vector<PoseRow>& moments);

}  // namespace mocap

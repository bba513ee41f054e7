// §7.1, §7.3: the first pose of a body of given sizes, and the one that faces the other way.
#pragma once

#include <vector>

#include "core/acquisition/body_localizer.h"
#include "core/tracking/tracker.h"

namespace mocap {

enum class TrunkSize { kGiven, kMeasured };

/// Draws guesses at the pose of a body that was just located to the evidence.
/// @param trunk  whether to measure it on the evidence first: an arm is not looked for where its
///               flesh is taken for a belly's, and bellies differ more than all else.
/// @return  the best fit, then the best of those that face the other way, if there is any; none
/// when all guesses end upside down.
std::vector<Tracker> FitBody(const BodyModel& body, const Evidence& evidence,
                             const LocalizedBody& located, TrunkSize trunk);

}  // namespace mocap

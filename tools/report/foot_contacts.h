// Contacts of feet with the floor, and how still standing feet are, against the truth.
#pragma once

#include <span>

#include "tools/report/extremity_accuracy.h"

namespace mocap {

/// Sets the contacts and the skating of an accuracy; its other figures stay.
void MeasureContacts(const Result& result, const TakeTruth& truth,
                     std::span<const FrameError> frames, ExtremityAccuracy& accuracy);

}  // namespace mocap

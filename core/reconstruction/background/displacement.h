// §4: whether a camera was nudged since its background was learned.
#pragma once

#include <optional>

#include "core/reconstruction/background/conditions.h"
#include "core/reconstruction/background/half_picture.h"

namespace mocap {

/// Measures how far a picture lies from what is expected, to a few hundredths of a pixel where it
/// is less than two pixels.
///
/// Least squares on brightness and its gradient (Lucas, Kanade 1981), without what differs more
/// than a small displacement explains: persons.
/// @param gain  what the picture's green is multiplied by.
/// @return      nothing where too few contours show it.
std::optional<Displacement> MeasureDisplacement(const HalfPicture& live, float gain,
                                                const ExpectedHalf& expected);

}  // namespace mocap

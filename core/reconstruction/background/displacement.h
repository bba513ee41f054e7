// §4: detects that a camera was nudged after its background was learned.
#pragma once

#include <optional>

#include "core/reconstruction/background/conditions.h"
#include "core/reconstruction/background/half_picture.h"

namespace mocap {

/// Measures the displacement of a picture from the expected one. Below two pixels the error
/// is a few hundredths of a pixel.
///
/// Least squares on brightness and its gradient (Lucas, Kanade 1981). Differences that no small
/// displacement explains, such as people, are left out.
/// @param gain  factor for the picture's green channel.
/// @return      nothing if too few contours show the displacement.
std::optional<Displacement> MeasureDisplacement(const HalfPicture& live, float gain,
                                                const ExpectedHalf& expected);

}  // namespace mocap

// Numbers in tables.
#pragma once

#include <numbers>
#include <string>

namespace mocap {

/// Formats a number with fixed decimals. Never -0, which would make equal numbers
/// differ; nan if it is not a number.
std::string FixedText(double value, int decimals);

/// Files have angles in degrees.
inline constexpr double kDegreesPerRad = 180 / std::numbers::pi;

}  // namespace mocap

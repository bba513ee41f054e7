// Degrees, for people and files; everywhere else, angles are radians.
#pragma once

#include <numbers>

namespace mocap {

inline constexpr double kDegreesPerRad = 180 / std::numbers::pi;

}  // namespace mocap

// Joint angles over the gait cycle.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tools/gait/gait_figures.h"
#include "tools/kinematics/joint_angles.h"

namespace mocap {

/// A cycle runs from 0 to 100 %, a foot's strike to its next, by whole percents.
inline constexpr int kCycleSamples = 101;

/// One angle over the cycles of one side: mean and standard deviation over its strides [degrees].
struct CycleCurve {
  std::string angle;  ///< As in kCoordinateNames.
  Side side = Side::kLeft;
  int strides = 0;
  std::array<double, kCycleSamples> mean_deg{}, spread_deg{};
};

/// Computes the curve of each angle of a limb over the strides of its side, and those of pelvis and
/// trunk over the strides of either. Those of the pelvis are relative to the walker's frame
/// (BodyAngles). Angles without strides, and those
/// that the result does not show, are left out.
/// @param angles  of the tracked frames. @param start_ns  the time from which strides count.
std::vector<CycleCurve> CurvesOf(std::span<const BodyAngles> angles, std::int64_t start_ns,
                                 std::span<const Stride> strides);

}  // namespace mocap

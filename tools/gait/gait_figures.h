// Spatial and temporal parameters of gait. Lengths and widths refer to the line between two strikes
// of one foot, so that they also hold on curved paths (Huxham et al. 2006).
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "tools/gait/mean_and_spread.h"
#include "tools/kinematics/gait_events.h"

namespace mocap {

/// One stride of a foot: from a strike to its next one.
struct Stride {
  Side side = Side::kLeft;
  double begin_s = 0, end_s = 0;
  double off_s = 0;              ///< The foot's off in between.
  double opposite_strike_s = 0;  ///< First strike of the other foot in between.
  double opposite_off_s = 0;     ///< Its off before that strike; before begin_s for runners.
  double length_mm = 0;          ///< Of the stride line, from the heel's first place to its second.
  double step_length_mm = 0;     ///< From the other heel to this one, along that line.
  double step_width_mm = 0;      ///< The same across the line; negative for feet that cross.
  double speed_mm_s = 0;         ///< Of the middle of the hip joints.

  double duration_s() const { return end_s - begin_s; }
  /// While both feet are on the floor; a runner's never are.
  double both_s() const {
    return std::max(0.0, opposite_off_s - begin_s) + std::max(0.0, off_s - opposite_strike_s);
  }
};

/// The figures that are given for each stride, in the order of kGaitFigures.
struct GaitFigure {
  std::string_view name;
  std::string_view unit;
  double (*of)(const Stride& stride);
};
inline constexpr std::size_t kGaitFigureCount = 11;
extern const std::array<GaitFigure, kGaitFigureCount> kGaitFigures;

struct GaitSummary {
  /// Over the strides of a side: by side and figure.
  std::array<std::array<MeanAndSpread, kGaitFigureCount>, 2> figures;
  /// 2 (left − right) / (left + right) of the means, in percent (Robinson, Herzog, Nigg 1987); NaN
  /// if a side has no stride.
  std::array<double, kGaitFigureCount> symmetry_percent;
};

/// A foot on the floor, from a strike to its off.
struct StancePhase {
  Side side;
  double begin_s, end_s;
};

/// Lists the stances of a run whose strike and off were found, by side and in order of time.
std::vector<StancePhase> StancePhasesOf(std::span<const GaitEvent> events);

/// Lists the strides of a run that have all four of their events, in order of time. Steps on the
/// spot are none.
std::vector<Stride> StridesOf(std::span<const GaitFrame> run, std::span<const GaitEvent> events);

GaitSummary Summarize(std::span<const Stride> strides);

}  // namespace mocap

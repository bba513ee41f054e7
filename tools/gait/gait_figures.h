// Spatial and temporal parameters of gait. Lengths and widths refer to the line between two strikes
// of one foot, so that they also hold on curved paths (Huxham et al. 2006).
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "tools/kinematics/gait_events.h"

namespace mocap {

/// One stride of a foot: from a strike to its next one.
struct Stride {
  Side side = Side::kLeft;
  double begin_s = 0, end_s = 0;
  double off_s = 0;              ///< When the foot left the floor in between.
  double opposite_off_s = 0;     ///< When the other one left it before it
  double opposite_strike_s = 0;  ///< struck in between. A runner's left it before begin_s.
  double length_mm = 0;          ///< Way of the heel: the stride line.
  double step_length_mm = 0;     ///< From the other heel to this one, along that line,
  double step_width_mm = 0;      ///< and across it; negative for feet that cross.
  double speed_mm_s = 0;

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
extern const std::array<GaitFigure, 11> kGaitFigures;

/// Mean and standard deviation of a figure over strides of one side.
struct MeanAndSpread {
  int count = 0;
  double mean = 0, spread = 0;
};

struct GaitSummary {
  /// By side and figure.
  std::array<std::array<MeanAndSpread, 11>, 2> figures;
  /// 2 (left − right) / (left + right) of the means, in percent (Robinson, Herzog, Nigg 1987); NaN
  /// if a side has no stride.
  std::array<double, 11> symmetry_percent;
};

/// Lists the strides of a run that have all four of their events, in order of time. Steps on the
/// spot are none.
std::vector<Stride> StridesOf(std::span<const GaitFrame> run, std::span<const GaitEvent> events);

GaitSummary Summarize(std::span<const Stride> strides);

}  // namespace mocap

// What `mocap gait` finds, for a terminal.
#pragma once

#include <string>

#include "tools/gait/gait_analysis.h"

namespace mocap {

/// What the events were found by, and how those found in another way agree.
std::string EventsText(const GaitAnalysis& gait);

/// Mean and standard deviation, such as "572 ± 12"; "-" without strides.
std::string MeasuredText(const GaitFigure& figure, const MeanAndSpread& measured);
/// A symmetry index; "-" if it is not known.
std::string SymmetryText(double percent);

/// A table of figures by side.
std::string GaitText(const GaitAnalysis& gait);

}  // namespace mocap

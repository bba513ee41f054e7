// What a result says of its own error, and how true that is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/accuracy.h"
#include "tools/report/probability_check.h"
#include "tools/results/result.h"

namespace mocap {

/// What the truth says of fit, deviations and probabilities.
struct CertaintyCheck {
  /// Mean error of the points in the half of the frames with the better fit, and in the other.
  double better_half_mm = 0, worse_half_mm = 0;
  /// Share of the points' errors that are within twice their deviation; empty without deviations.
  std::optional<double> within_two_deviations;
  ProbabilityCheck probabilities = {};
};

/// Over tracked frames.
struct Certainty {
  double median_fit_mm = 0, p95_fit_mm = 0;   ///< Of PoseRow::residual_mm.
  std::optional<double> median_deviation_mm;  ///< Over all points; empty if none is known.
  std::optional<CertaintyCheck> check;        ///< Only with truth.
};

/// Measures it; empty if no frame is tracked.
/// @param accuracy  of these poses, if there is truth.
std::optional<Certainty> MeasureCertainty(const std::vector<PoseRow>& poses,
                                          const std::optional<Accuracy>& accuracy);

/// Lines for a terminal, without probabilities.
std::string CertaintyText(const Certainty& certainty);
/// ProbabilityTable of a result; empty without truth.
std::string ProbabilityTextOf(const std::optional<Certainty>& certainty);

}  // namespace mocap

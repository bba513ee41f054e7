// §8: all figures for a result, with and without truth.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/evaluation/accuracy.h"
#include "core/evaluation/precision.h"
#include "tools/report/certainty.h"
#include "tools/report/extremity_accuracy.h"
#include "tools/results/result.h"
#include "tools/results/take_truth.h"

namespace mocap {

/// An acquired length with the true one.
struct LengthPair {
  std::string name;
  double acquired_mm = 0;
  double true_mm = 0;
};

struct Evaluation {
  std::string take;
  Result result;
  std::array<int, kCaptureStateNames.size()> frames_in_state{};
  int first_tracked_pose = -1;  ///< -1: never tracked.
  /// Share of tracked frames since the first one; 0 when there is none.
  double tracked_share = 0;
  double mean_residual_mm = 0;         ///< Over tracked frames.
  std::optional<Precision> precision;  ///< Empty if no run of tracked frames is long enough.
  std::optional<Certainty> certainty;  ///< Empty if never tracked.
  std::optional<double> jitter_mm;     ///< MeanThirdDifference_mm of tracked frames.
  // Only if the take has truth:
  std::optional<TakeTruth> truth;
  std::optional<Accuracy> accuracy;
  std::optional<double> true_jitter_mm;  ///< That of the true motion in the same frames.
  ExtremityAccuracy extremities;
  std::vector<LengthPair> lengths;
};

/// Compares the acquired lengths with the true ones.
std::vector<LengthPair> CompareLengths(const BodySizes& sizes, const TakeTruth& truth);

/// Computes the quality of a result by itself and, if available, against the truth.
Evaluation Evaluate(Result result, std::optional<TakeTruth> truth);

}  // namespace mocap

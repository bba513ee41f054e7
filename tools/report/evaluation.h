// §8: all figures about a result, with and without truth.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/evaluation/accuracy.h"
#include "core/evaluation/precision.h"
#include "tools/results/result.h"
#include "tools/results/take_truth.h"

namespace mocap {

/// A length of the acquired body beside the true one.
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
  /// Tracked frames from the first tracked one on; 0 when there is none.
  double tracked_share = 0;
  double mean_residual_mm = 0;         ///< Over tracked frames.
  std::optional<Precision> precision;  ///< Empty when no run of tracked frames is long enough.
  // Only for a take with truth:
  std::optional<TakeTruth> truth;
  std::optional<Accuracy> accuracy;
  std::vector<LengthPair> lengths;
};

/// Holds the acquired lengths against the true ones.
std::vector<LengthPair> CompareLengths(const BodySizes& sizes, const TakeTruth& truth);

/// Says how good a result is, by itself and, where there is one, against the truth.
Evaluation Evaluate(Result result, std::optional<TakeTruth> truth);

/// What the sixteen angles of Table 1 turn, and about which axis of the torso.
inline constexpr std::array<std::string_view, kPaperAngleCount> kPaperAngleLabels = {
    "neck, x",       "neck, y",       "shoulder L, x", "shoulder R, x",
    "shoulder L, z", "shoulder R, z", "shoulder L, y", "shoulder R, y",
    "elbow L, z",    "elbow R, z",    "hip L, x",      "hip R, x",
    "hip L, y",      "hip R, y",      "knee L, y",     "knee R, y"};

inline constexpr double kDegreesPerRadian = 57.29577951308232;

}  // namespace mocap

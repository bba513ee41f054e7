// Runs on the same pictures that begin with different frame sets: how much of an error is luck.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/evaluation/accuracy.h"

namespace mocap {

/// The errors of one person in a run, by numbers that mean the same set in every run.
using ErrorsBySet = std::map<std::int64_t, FrameError>;

/// Errors over sets.
struct PoseErrors {
  double mean_mm = 0, p95_mm = 0;  ///< Over all points and sets.
  double angle_deg = 0;
};

/// One of several runs.
struct FirstScore {
  std::optional<PoseErrors> errors;  ///< Empty: the person was never tracked.
  double tracked_share = 0;          ///< Of the sets in which the person should be tracked.
};

/// Several runs on one person, the k-th of which began with set k.
struct PersonScore {
  std::vector<FirstScore> firsts;
  int sets = 0;  ///< That are scored: all runs track the person, except those that never do.

  /// Means over the runs; empty if none tracked the person.
  std::optional<PoseErrors> Mean() const;
  double tracked_share() const;
  /// Largest less smallest mean error of a run; 0 if none tracked the person.
  double spread_mm() const;
};

/// Scores runs on the sets that they have in common, so that a run is not better for having missed
/// the difficult ones.
/// @param wanted  the sets in which the person should be tracked; others do not count. Not empty.
PersonScore ScoreFirsts(std::span<const ErrorsBySet> runs, std::span<const std::int64_t> wanted);

}  // namespace mocap

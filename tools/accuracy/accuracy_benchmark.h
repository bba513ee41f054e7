// Accuracy benchmark: a grid of simulated takes, and the effects of cameras, voxel size, noise and
// calibration errors.
#pragma once

#include <string>
#include <vector>

#include "tools/accuracy/accuracy_trial.h"
#include "tools/accuracy/people_trial.h"

namespace mocap {

/// Tracking accuracy of one take.
struct AccuracyRow {
  std::string motion;
  double stature_mm = 0;
  std::uint64_t seed = 0;
  double mpjpe_mm = 0, p95_mm = 0, angle_deg = 0;
  double length_error_mm = 0;  ///< Mean over the parts.
  double tracked_share = 0;    ///< From the first tracked frame set on.
  double head_found_share = 0;
  int acquisition_frames = 0;
  int longest_wrong_stretch = 0;  ///< In frame sets, as in TrialOutcome.
  int found_after = -1;           ///< Frame sets until tracked for the first time; -1: never.
  int longest_loss = 0;           ///< In frame sets, as in TrialOutcome.
  ExtremityAccuracy extremities = {};
};

/// Summarizes what a trial gave.
AccuracyRow RowOf(const AccuracyTrial& trial, const TrialOutcome& outcome);
/// Runs a trial and summarizes it.
AccuracyRow Measure(const AccuracyTrial& trial);

/// Means and extremes over takes; errors only over takes with tracking.
struct AccuracySummary {
  int takes = 0, takes_with_loss = 0, takes_with_wrong_stretch = 0;
  double mpjpe_mm = 0, worst_mpjpe_mm = 0, p95_mm = 0, angle_deg = 0, length_error_mm = 0;
  double tracked_share = 0, head_found_share = 0;
  double median_acquisition_frames = 0;
  int most_acquisition_frames = 0;
};

/// Of hands, feet and head. @param rows  may be none.
ExtremityAccuracy MeanExtremities(const std::vector<AccuracyRow>& rows);

/// A longer run of wrong poses is more than a glitch.
inline constexpr int kLongestGlitch = 5;

/// @param rows  at least one.
AccuracySummary Summarize(const std::vector<AccuracyRow>& rows);

/// One parameter made worse step by step; the others keep their defaults.
struct AccuracySweep {
  struct Step {
    std::string label;
    AccuracySummary summary;
  };
  std::string what;  ///< With unit.
  std::vector<Step> steps;
};

struct AccuracyBenchmark {
  double seconds = 0;  ///< Length of each take,
  std::vector<AccuracyRow> grid;
  std::vector<AccuracySweep> sweeps;
  AccuracySweep studios = {};  ///< Without steps if not measured.
  double people_seconds = 0;   ///< and of each with several people,
  double studio_seconds = 0;   ///< and of each in a studio of another kind.
  std::vector<PeopleRow> people = {};
};

}  // namespace mocap

#include "tools/accuracy/accuracy_benchmark.h"

#include <algorithm>
#include <cmath>

#include "core/degrees.h"

namespace mocap {

AccuracyRow Measure(const AccuracyTrial& trial) { return RowOf(trial, RunTrial(trial)); }

AccuracyRow RowOf(const AccuracyTrial& trial, const TrialOutcome& outcome) {
  const Accuracy& accuracy = *outcome.evaluation.accuracy;
  AccuracyRow row{.motion = trial.studio.motion,
                  .stature_mm = trial.studio.stature_mm,
                  .seed = trial.studio.seed};
  row.mpjpe_mm = accuracy.distance_mm.mean;
  row.p95_mm = accuracy.distance_mm.p95;
  row.angle_deg = accuracy.mean_angle_rad * kDegreesPerRad;
  row.tracked_share = accuracy.tracked_share;
  row.head_found_share = accuracy.head_found_share;
  row.acquisition_frames = outcome.acquisition_frames;
  row.longest_wrong_stretch = outcome.longest_wrong_stretch;
  row.found_after = outcome.evaluation.first_tracked_pose;
  row.longest_loss = outcome.longest_loss;
  row.extremities = outcome.evaluation.extremities;
  for (const LengthPair& pair : outcome.evaluation.lengths) {
    row.length_error_mm += std::abs(pair.acquired_mm - pair.true_mm) /
                           static_cast<double>(outcome.evaluation.lengths.size());
  }
  return row;
}

ExtremityAccuracy MeanExtremities(const std::vector<AccuracyRow>& rows) {
  std::vector<ExtremityAccuracy> takes;
  for (const AccuracyRow& row : rows) takes.push_back(row.extremities);
  return MeanOf(takes);
}

AccuracySummary Summarize(const std::vector<AccuracyRow>& rows) {
  AccuracySummary summary;
  summary.takes = static_cast<int>(rows.size());
  const auto was_tracked = [](const AccuracyRow& row) { return row.tracked_share > 0; };
  const auto tracked = std::max<std::ptrdiff_t>(1, std::ranges::count_if(rows, was_tracked));
  std::vector<int> acquisition;
  for (const AccuracyRow& row : rows) {
    // Without tracking there are no errors.
    const double error_weight = 1.0 / static_cast<double>(tracked);
    summary.mpjpe_mm += error_weight * row.mpjpe_mm;
    summary.p95_mm += error_weight * row.p95_mm;
    summary.angle_deg += error_weight * row.angle_deg;
    summary.length_error_mm += error_weight * (was_tracked(row) ? row.length_error_mm : 0);
    const double weight = 1.0 / summary.takes;
    summary.tracked_share += weight * row.tracked_share;
    summary.head_found_share += weight * row.head_found_share;
    summary.worst_mpjpe_mm = std::max(summary.worst_mpjpe_mm, row.mpjpe_mm);
    summary.takes_with_loss += row.tracked_share < 1;
    summary.takes_with_wrong_stretch += row.longest_wrong_stretch > kLongestGlitch;
    acquisition.push_back(row.acquisition_frames);
  }
  const auto middle = acquisition.begin() + static_cast<std::ptrdiff_t>(acquisition.size() / 2);
  std::ranges::nth_element(acquisition, middle);
  summary.median_acquisition_frames = *middle;
  summary.most_acquisition_frames = std::ranges::max(acquisition);
  return summary;
}

}  // namespace mocap

#include "tools/report/evaluation.h"

#include <algorithm>
#include <utility>

#include "core/evaluation/jitter.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

/// Runs of tracked frames without a gap.
std::vector<std::vector<PoseSample>> TrackedRuns(const std::vector<PoseRow>& poses) {
  std::vector<std::vector<PoseSample>> runs;
  bool in_run = false;
  for (const PoseRow& row : poses) {
    if (IsTracked(row)) {
      if (!in_run) runs.emplace_back();
      runs.back().push_back({row.paper, row.points_W});
    }
    in_run = IsTracked(row);
  }
  return runs;
}

/// Runs of the tracked frames' points, and of the truth's in the frames that have one.
struct PointRuns {
  std::vector<std::vector<ScoredPoints>> tracked, true_ones;
};

PointRuns PointRunsOf(const Evaluation& evaluation) {
  const std::vector<PoseRow>& poses = evaluation.result.poses;
  std::vector<const ScoredPoints*> truth(poses.size());
  if (evaluation.accuracy)
    for (const FrameError& frame : evaluation.accuracy->frames)
      truth[frame.pose] = &evaluation.truth->frames[frame.truth].points_W;
  PointRuns runs;
  bool in_run = false, in_true_run = false;
  const auto add = [](bool goes_on, const ScoredPoints& points_W, auto& of_runs) {
    if (!goes_on) of_runs.emplace_back();
    of_runs.back().push_back(points_W);
  };
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool is_tracked = IsTracked(poses[i]);
    if (is_tracked) add(in_run, ScoredPointsOf(poses[i].points_W), runs.tracked);
    if (truth[i]) add(in_true_run, *truth[i], runs.true_ones);
    in_run = is_tracked;
    in_true_run = truth[i] != nullptr;
  }
  return runs;
}

void MeasureJitter(Evaluation& evaluation) {
  const PointRuns runs = PointRunsOf(evaluation);
  evaluation.jitter_mm = MeanThirdDifference_mm(runs.tracked);
  evaluation.true_jitter_mm = MeanThirdDifference_mm(runs.true_ones);
}

void CountStates(Evaluation& evaluation) {
  const std::vector<PoseRow>& poses = evaluation.result.poses;
  int tracked = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ++evaluation.frames_in_state[static_cast<std::size_t>(poses[i].state)];
    if (!IsTracked(poses[i])) continue;
    if (tracked == 0) evaluation.first_tracked_pose = static_cast<int>(i);
    ++tracked;
    evaluation.mean_residual_mm += poses[i].residual_mm;
  }
  if (tracked == 0) return;
  evaluation.mean_residual_mm /= tracked;
  evaluation.tracked_share =
      tracked / static_cast<double>(poses.size() - evaluation.first_tracked_pose);
}

}  // namespace

std::vector<LengthPair> CompareLengths(const BodySizes& sizes, const TakeTruth& truth) {
  const std::pair<const char*, double> acquired[] = {
      {"torso", sizes.torso},         {"head", sizes.head},   {"upper_arm", sizes.upper_arm},
      {"lower_arm", sizes.lower_arm}, {"thigh", sizes.thigh}, {"calf", sizes.calf}};
  std::vector<LengthPair> pairs;
  for (const auto& [name, length_mm] : acquired) {
    const auto found = truth.lengths_mm.find(name);
    if (found != truth.lengths_mm.end()) pairs.push_back({name, length_mm, found->second});
  }
  return pairs;
}

Evaluation Evaluate(Result result, std::optional<TakeTruth> truth) {
  Evaluation evaluation;
  evaluation.result = std::move(result);
  evaluation.truth = std::move(truth);
  CountStates(evaluation);
  evaluation.precision = MeasurePrecision(TrackedRuns(evaluation.result.poses), {});
  if (!evaluation.truth) {
    evaluation.certainty = MeasureCertainty(evaluation.result.poses, {});
    MeasureJitter(evaluation);
    return evaluation;
  }
  std::vector<ScoredFrame> output;
  for (const PoseRow& row : evaluation.result.poses) {
    output.push_back({row.timestamp_ns, IsTracked(row), ScoredPointsOf(row.points_W)});
  }
  evaluation.accuracy = MeasureAccuracy(evaluation.truth->frames, output);
  MeasureJitter(evaluation);
  evaluation.extremities =
      MeasureExtremities(evaluation.result, *evaluation.truth, evaluation.accuracy->frames);
  evaluation.certainty = MeasureCertainty(evaluation.result.poses, evaluation.accuracy);
  evaluation.lengths = CompareLengths(evaluation.result.body.sizes, *evaluation.truth);
  return evaluation;
}

}  // namespace mocap

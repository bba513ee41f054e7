#include "core/acquisition/model_acquirer.h"

#include <algorithm>
#include <array>

#include "core/acquisition/body_localizer.h"
#include "core/acquisition/pose_hypotheses.h"
#include "core/acquisition/size_fit.h"

namespace mocap {
namespace {

// Hair and soles, which a silhouette shows and a stadiometer does not.
constexpr double kHairAndSolesMm = 25;
constexpr double kWorstCostMm = 60;
constexpr double kSettledMm = 3;         // §8.1
constexpr double kClearlyBetter = 1.12;  // of two facings
constexpr int kFramesToDecide = 6;

// What the network takes as evidence, and what is measured well enough to be believed as it is.
constexpr std::array<double BodySizes::*, 10> kWidths = {
    &BodySizes::torso_width,     &BodySizes::torso_depth,
    &BodySizes::head_width,      &BodySizes::upper_arm_width,
    &BodySizes::lower_arm_width, &BodySizes::thigh_width,
    &BodySizes::calf_width,      &BodySizes::shoulder_width,
    &BodySizes::hip_width,       &BodySizes::neck};
constexpr std::array<double BodySizes::*, 14> kMeasured = {
    &BodySizes::thigh,           &BodySizes::calf,
    &BodySizes::upper_arm,       &BodySizes::lower_arm,
    &BodySizes::torso_width,     &BodySizes::torso_depth,
    &BodySizes::head_width,      &BodySizes::upper_arm_width,
    &BodySizes::lower_arm_width, &BodySizes::thigh_width,
    &BodySizes::calf_width,      &BodySizes::shoulder_width,
    &BodySizes::hip_width,       &BodySizes::neck};

struct Candidate {
  PoseState pose;
  double cost_mm;
};

// How closely guesses are drawn to the voxels, and how many of them go on.
struct Round {
  SurfaceFitOptions options;
  int iterations;
  std::size_t kept;
};

SurfaceFitOptions Samples(int voxels, int edges) {
  SurfaceFitOptions options;
  options.voxels = voxels;
  options.edges = edges;
  return options;
}

void Improve(const BodyModel& body, SurfaceFit& fit, int iterations, Candidate& candidate) {
  PoseFilter filter{MotionNoise{}};
  filter.Reset(candidate.pose, 100, 0.5);
  filter.Update(
      body.table(),
      [&](const PoseState& pose, UpdateEquations& equations) {
        fit.Linearize(body, pose, equations);
      },
      iterations);
  candidate = {filter.pose(), fit.QualityAt(body, filter.pose()).Cost()};
}

// Most guesses are far off, and a glance tells: the better they are, the closer they are looked at.
// The best comes first.
std::vector<Candidate> Compete(const BodyModel& body, const Evidence& evidence,
                               const std::vector<PoseState>& guesses) {
  const std::array<Round, 2> rounds = {Round{Samples(40, 80), 1, 10}, {Samples(150, 200), 4, 10}};
  std::vector<Candidate> candidates;
  for (const PoseState& guess : guesses) candidates.push_back({guess, 0});
  for (const Round& round : rounds) {
    SurfaceFit fit(round.options);
    fit.SetEvidence(evidence);
    for (Candidate& candidate : candidates) Improve(body, fit, round.iterations, candidate);
    std::ranges::stable_sort(candidates, {}, &Candidate::cost_mm);
    candidates.resize(std::min(candidates.size(), round.kept));
  }
  return candidates;
}

bool FaceApart(const PoseState& a, const PoseState& b) {
  return a.X_WT.R.col(0).dot(b.X_WT.R.col(0)) < -0.3;
}

}  // namespace

bool ModelAcquirer::Locate(const Evidence& evidence, const std::optional<BodySizes>& known) {
  const std::optional<LocalizedBody> located = LocalizeBody(evidence.cloud);
  if (!located) return false;
  height_mm_ = located->height_mm - kHairAndSolesMm;
  const BodyModel body(table_, known ? *known : AverageSizes(height_mm_));
  const std::vector<Candidate> candidates = Compete(body, evidence, PoseHypotheses(body, *located));
  if (candidates.front().cost_mm > kWorstCostMm) return false;

  hypotheses_.clear();
  hypotheses_.push_back({Tracker(body, candidates.front().pose)});
  const auto opposite =
      std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
        return FaceApart(candidate.pose, candidates.front().pose);
      });
  if (opposite != candidates.end()) hypotheses_.push_back({Tracker(body, opposite->pose)});
  frames_ = 0;
  settled_ = false;
  Refine(evidence, 0);
  if (known) {
    for (Hypothesis& hypothesis : hypotheses_) hypothesis.tracker.Resize(*known);
    settled_ = true;
  }
  return true;
}

double ModelAcquirer::RefineSizes(Hypothesis& hypothesis, bool remember) {
  Tracker& tracker = hypothesis.tracker;
  const BodySizes measured =
      MeasureSizes(tracker.body(), tracker.surface_fit(), tracker.filter().pose(), SizeSpread{});
  // The mean over the frames is the evidence, so that it grows and the sizes come to rest.
  const double share = 1.0 / frames_;
  for (double BodySizes::*size : kMeasured) {
    hypothesis.measured.*size += share * (measured.*size - hypothesis.measured.*size);
  }
  const BodySizes& mean = hypothesis.measured;
  BodySizes sizes = tracker.body().sizes();
  const LengthMeasurements lengths{.thigh = mean.thigh,
                                   .calf = mean.calf,
                                   .upper_arm = mean.upper_arm,
                                   .lower_arm = mean.lower_arm,
                                   .height = height_mm_ - sizes.neck - sizes.head / 2};
  const double change_mm = network_.Update(lengths, remember, sizes);
  for (double BodySizes::*width : kWidths) sizes.*width = mean.*width;
  tracker.Resize(sizes);
  return change_mm;
}

void ModelAcquirer::Refine(const Evidence& evidence, double dt_s) {
  ++frames_;
  double change_mm = 0;
  for (Hypothesis& hypothesis : hypotheses_) {
    hypothesis.tracker.Update(evidence, dt_s);
    hypothesis.cost_sum += hypothesis.tracker.quality().Cost();
    const double change = RefineSizes(hypothesis, frames_ > 1);
    if (&hypothesis == &hypotheses_.front()) change_mm = change;
  }
  if (hypotheses_.size() == 2) {
    Hypothesis& first = hypotheses_[0];
    Hypothesis& second = hypotheses_[1];
    if (second.cost_sum < first.cost_sum) std::swap(first, second);
    const bool clear = hypotheses_[1].cost_sum > kClearlyBetter * hypotheses_[0].cost_sum;
    if (clear || frames_ >= kFramesToDecide) hypotheses_.pop_back();
  }
  settled_ = hypotheses_.size() == 1 && frames_ > 1 && change_mm < kSettledMm;
}

}  // namespace mocap

#include "core/acquisition/model_acquirer.h"

#include <algorithm>
#include <array>
#include <limits>

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

// The statures that are tried, as shares of the height: of somebody who sits, crouches or jumps it
// says little.
constexpr std::array<double, 6> kStatures = {1, 1.12, 0.89, 1.25, 0.8, 1.4};
constexpr int kStaturesPerFrame = 2;
constexpr double kSmallestMm = 1000;
constexpr double kLargestMm = 2100;
// What costs no more needs no other stature.
constexpr double kGoodCostMm = 30;
// So many guesses are followed closely, limbs and all.
constexpr std::size_t kFinalists = 3;

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

// Nobody is acquired upside down.
bool IsUpright(const Candidate& candidate) { return candidate.pose.X_WT.R(2, 2) > 0; }

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
    std::erase_if(candidates, [](const Candidate& candidate) { return !IsUpright(candidate); });
    std::ranges::stable_sort(candidates, {}, &Candidate::cost_mm);
    candidates.resize(std::min(candidates.size(), round.kept));
  }
  return candidates;
}

bool FaceApart(const PoseState& a, const PoseState& b) {
  return a.X_WT.R.col(0).dot(b.X_WT.R.col(0)) < -0.3;
}

// The finalists, followed closely, the best first; and the best that faces the other way.
std::vector<Tracker> FitBody(const BodyModel& body, const Evidence& evidence,
                             const LocalizedBody& located) {
  const std::vector<Candidate> candidates = Compete(body, evidence, PoseHypotheses(body, located));
  std::vector<Tracker> found;
  for (std::size_t i = 0; i < std::min(kFinalists, candidates.size()); ++i) {
    found.emplace_back(body, candidates[i].pose).Update(evidence, 0);
  }
  if (found.empty()) return found;
  const auto cost = [](const Tracker& tracker) { return tracker.quality().Cost(); };
  std::ranges::stable_sort(found, {}, cost);
  found.resize(1, found.front());
  const auto opposite = std::ranges::find_if(candidates, [&](const Candidate& candidate) {
    return FaceApart(candidate.pose, found.front().filter().pose());
  });
  if (opposite == candidates.end()) return found;
  found.emplace_back(body, opposite->pose).Update(evidence, 0);
  std::ranges::stable_sort(found, {}, cost);
  return found;
}

double CostOf(const std::vector<Tracker>& found) {
  return found.empty() ? std::numeric_limits<double>::infinity() : found.front().quality().Cost();
}

}  // namespace

bool ModelAcquirer::Locate(const Evidence& evidence, const std::optional<BodySizes>& known) {
  const std::optional<LocalizedBody> located = LocalizeBody(evidence.cloud);
  if (!located) return false;
  height_mm_ = located->height_mm - kHairAndSolesMm;
  if (known) {
    const std::vector<Tracker> found = FitBody(BodyModel(table_, *known), evidence, *located);
    if (CostOf(found) > kWorstCostMm) return false;
    Begin(found, evidence);
    for (Hypothesis& hypothesis : hypotheses_) hypothesis.tracker.Resize(*known);
    settled_ = true;
    return true;
  }
  for (int i = 0; i < kStaturesPerFrame; ++i) {
    if (TryStature(evidence, *located)) return true;
  }
  return false;
}

bool ModelAcquirer::TryStature(const Evidence& evidence, const LocalizedBody& located) {
  // After all of them comes the likeliest again.
  const bool is_last = next_stature_ == std::ssize(kStatures);
  const double share = is_last ? likely_stature_ : kStatures[next_stature_];
  next_stature_ = is_last ? 0 : next_stature_ + 1;
  if (next_stature_ == 1) likely_cost_mm_ = kWorstCostMm;
  const double stature_mm = share * height_mm_;
  if (stature_mm < kSmallestMm || stature_mm > kLargestMm) return false;
  const std::vector<Tracker> found =
      FitBody(BodyModel(table_, AverageSizes(stature_mm)), evidence, located);
  const double cost_mm = CostOf(found);
  if (cost_mm < likely_cost_mm_) {
    likely_cost_mm_ = cost_mm;
    likely_stature_ = share;
  }
  if (cost_mm > (is_last ? kWorstCostMm : kGoodCostMm)) return false;
  is_upright_ = share == 1;
  next_stature_ = 0;
  Begin(found, evidence);
  return true;
}

void ModelAcquirer::Begin(const std::vector<Tracker>& found, const Evidence& evidence) {
  hypotheses_.clear();
  for (const Tracker& tracker : found) hypotheses_.push_back({tracker});
  frames_ = 0;
  settled_ = false;
  Refine(evidence, 0);
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
  LengthMeasurements lengths{.thigh = mean.thigh,
                             .calf = mean.calf,
                             .upper_arm = mean.upper_arm,
                             .lower_arm = mean.lower_arm,
                             .height = {}};
  if (is_upright_) lengths.height = height_mm_ - sizes.neck - sizes.head / 2;
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

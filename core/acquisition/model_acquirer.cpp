#include "core/acquisition/model_acquirer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace mocap {
namespace {

// A first fit is rejected if it costs more, or if its bones are this far from any flesh.
constexpr double kWorstCostMm = 34;
constexpr double kMostHollowMm = 22;
// If other sizes explain somebody better by this much, he is not the known person.
constexpr double kStrangerBetterMm = 6;
// Number of candidates that are tracked with all limbs: at full effort, and otherwise.
constexpr std::size_t kFinalists = 3;
constexpr std::size_t kFewFinalists = 1;
constexpr double kSettledMm = 3;  // §8.1
constexpr int kSizeIterations = 3;
constexpr int kFramesToSettle = 6;

bool LiesInFlesh(const Tracker& tracker) { return tracker.quality().hollow_mm < kMostHollowMm; }

double CostOf(const Tracker& tracker) {
  return LiesInFlesh(tracker) ? tracker.quality().Cost() : std::numeric_limits<double>::infinity();
}

double PriorCostMm(const Tracker& tracker, const PosePrior& prior) {
  return prior.CostMm(tracker.body(), tracker.filter().pose());
}

bool IsCredible(const Tracker& tracker) {
  return LiesInFlesh(tracker) && tracker.quality().CostWithoutStray() <= kWorstCostMm;
}

bool FaceApart(const PoseState& a, const PoseState& b) {
  return a.X_WT.R.col(0).dot(b.X_WT.R.col(0)) < -0.3;
}

// Measures the sizes in a frame repeatedly, each time from the pose that the new sizes lead to.
void MeasureIn(Tracker& tracker, SizeRefiner& sizes) {
  const SizeRefiner without_frame = sizes;
  for (int i = 0; i < kSizeIterations; ++i) {
    sizes = without_frame;
    sizes.Add(tracker.body(), tracker.surface_fit(), tracker.filter().pose());
    tracker.Resize(sizes.Sizes());
    tracker.Draw();
  }
}

}  // namespace

ModelAcquirer::ModelAcquirer(const BodyTable& table)
    : table_(table), strangers_(PoseContest::OfStrangers(table)) {}

void ModelAcquirer::StartOver() {
  strangers_.StartOver();
  acquainted_.reset();
}

PoseContest& ModelAcquirer::ContestFor(const std::optional<BodySizes>& known) {
  if (!known) return strangers_;
  if (!acquainted_ || !(acquainted_->body(0).sizes() == *known)) {
    acquainted_.emplace(BodyModel(table_, *known));
  }
  return *acquainted_;
}

bool ModelAcquirer::Locate(const Evidence& evidence, const std::optional<BodySizes>& known,
                           const SearchScope& scope, const std::optional<Vector3>& walks_W) {
  PoseContest& contest = ContestFor(known);
  const PosePrior prior = PriorOf(evidence, walks_W);
  const std::vector<PoseCandidate> candidates = contest.Hold(evidence, prior, scope);
  const std::size_t finalists = scope.effort < 1 ? kFewFinalists : kFinalists;
  hypotheses_.clear();
  for (std::size_t i = 0; i < std::min(finalists, candidates.size()); ++i)
    hypotheses_.push_back(Begin(contest, candidates[i], evidence, !known));
  if (hypotheses_.empty()) return false;
  const auto cost_mm = [&](const BodyHypothesis& hypothesis) {
    return CostOf(hypothesis.tracker) + PriorCostMm(hypothesis.tracker, prior);
  };
  std::ranges::stable_sort(hypotheses_, {}, cost_mm);
  hypotheses_.resize(1, hypotheses_.front());
  const Tracker& best = hypotheses_.front().tracker;
  contest.Remember(best.body().sizes(), best.filter().pose());
  if (!IsCredible(best)) return false;
  const auto opposite = std::ranges::find_if(candidates, [&](const PoseCandidate& candidate) {
    return FaceApart(candidate.pose, best.filter().pose());
  });
  if (opposite != candidates.end()) {
    hypotheses_.push_back(Begin(contest, *opposite, evidence, !known));
    std::ranges::stable_sort(hypotheses_, {}, cost_mm);
  }
  frames_ = 1;
  duel_ = {};
  settled_ = known.has_value();
  return true;
}

bool ModelAcquirer::IsStranger(const Evidence& evidence, double effort) {
  const PosePrior prior = PriorOf(evidence);
  const std::vector<PoseCandidate>& strangers = strangers_.Hold(evidence, prior, {effort});
  if (strangers.empty()) return false;
  const BodyHypothesis stranger = Begin(strangers_, strangers.front(), evidence, true);
  return CostOf(best()) > CostOf(stranger.tracker) + kStrangerBetterMm;
}

// @param measures  whether the sizes are unknown.
BodyHypothesis ModelAcquirer::Begin(const PoseContest& contest, const PoseCandidate& candidate,
                                    const Evidence& evidence, bool measures) {
  const BodyModel& body = contest.body(candidate.body);
  BodyHypothesis hypothesis{Tracker(body, candidate.pose), SizeRefiner(body)};
  Tracker& tracker = hypothesis.tracker;
  tracker.Allow(candidate.things);
  if (measures) {
    tracker.Look(evidence);
    MeasureIn(tracker, hypothesis.sizes);
  }
  tracker.Update(evidence, 0);
  if (measures) {
    hypothesis.sizes = SizeRefiner(body);
    MeasureIn(tracker, hypothesis.sizes);
  }
  return hypothesis;
}

void ModelAcquirer::Refine(const Evidence& evidence, double dt_s) {
  ++frames_;
  const double stature_mm = best().body().sizes().Stature();
  for (BodyHypothesis& hypothesis : hypotheses_) {
    Tracker& tracker = hypothesis.tracker;
    tracker.Update(evidence, dt_s);
    hypothesis.sizes.Add(tracker.body(), tracker.surface_fit(), tracker.filter().pose());
    tracker.Resize(hypothesis.sizes.Sizes());
  }
  const double change_mm = std::abs(best().body().sizes().Stature() - stature_mm);
  if (opposite()) CompareFacings(PriorOf(evidence), dt_s);
  // The lengths of somebody who crouches stay uncertain: tracking refines them later.
  settled_ = settled_ || change_mm < kSettledMm || frames_ >= kFramesToSettle;
}

void ModelAcquirer::CompareFacings(const PosePrior& prior, double dt_s) {
  const auto cost_mm = [&](int i) {
    const Tracker& tracker = hypotheses_[i].tracker;
    return tracker.quality().Cost() + PriorCostMm(tracker, prior);
  };
  const double lead_mm = cost_mm(1) - cost_mm(0);
  duel_.Add(lead_mm, dt_s);
  if (duel_.second_leads()) {
    std::swap(hypotheses_[0], hypotheses_[1]);
    duel_.Swap();
  }
  if (duel_.is_over()) hypotheses_.pop_back();
}

}  // namespace mocap

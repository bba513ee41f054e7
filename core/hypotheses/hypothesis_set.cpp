#include "core/hypotheses/hypothesis_set.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace mocap {
namespace {

bool AreSame(const Hypothesis& a, const Hypothesis& b) {
  return MeanDistance(a.body, a.filter.pose(), b.body, b.filter.pose()) < kOdds.same_mm;
}

// Frames that its sizes were measured in.
int FramesOf(const Hypothesis& hypothesis) {
  return hypothesis.sizes ? hypothesis.sizes->frames() : 0;
}

// Moves the body with the voxels if they moved farther than predicted and that explains them
// better.
void FollowLeap(Objective& objective, const Vector3& unforeseen_W, Hypothesis& hypothesis) {
  PoseState leapt = hypothesis.filter.pose();
  leapt.X_WT.p += unforeseen_W;
  const auto nats = [&](const PoseState& pose) {
    return objective.At(hypothesis.body, pose, hypothesis.things).Sum();
  };
  if (nats(leapt) < nats(hypothesis.filter.pose())) hypothesis.filter.Shift(unforeseen_W);
}

}  // namespace

double FrameWorth(double dt_s) { return kFrameWorth * std::min(1.0, dt_s / kOdds.alike_s); }

double HypothesisSet::NatsOf(const Fitness& fitness) const {
  const double keypoints = fitness[Term::kKeypoints];
  return worth_ * (fitness.Sum() - keypoints) + kViewWorth * keypoints;
}

void HypothesisSet::Begin(std::vector<Hypothesis> hypotheses,
                          const std::optional<Vector3>& middle_W) {
  hypotheses_ = std::move(hypotheses);
  middle_W_ = middle_W;
  worth_ = kFrameWorth;
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.nats = NatsOf(hypothesis.fitness);
  Judge();
}

void HypothesisSet::Follow(Objective& objective, double dt_s) {
  const Vector3 middle_W = objective.evidence().cloud.Centroid();
  const Vector3 moved_W = middle_W_ ? Vector3(middle_W - *middle_W_) : Vector3::Zero();
  worth_ = FrameWorth(dt_s);
  for (Hypothesis& hypothesis : hypotheses_) {
    const Vector3 before_W = hypothesis.filter.pose().X_WT.p;
    if (dt_s > 0) hypothesis.filter.Predict(dt_s);
    const Vector3 unforeseen_W = moved_W - (hypothesis.filter.pose().X_WT.p - before_W);
    if (middle_W_ && unforeseen_W.norm() > kOdds.leap_mm)
      FollowLeap(objective, unforeseen_W, hypothesis);
    hypothesis.Fit(objective);
    hypothesis.nats += NatsOf(hypothesis.fitness);
  }
  middle_W_ = middle_W;
  // As long as its limbs may be elsewhere, what it explained before counts for nothing.
  for (Hypothesis& hypothesis : hypotheses_)
    if (hypothesis.trials > 0)
      hypothesis.nats = best().nats + NatsOf(hypothesis.fitness) - NatsOf(best().fitness);
  Judge();
}

void HypothesisSet::Vary(Objective& objective, Hypothesis& present, const PoseState& pose) {
  const double start = objective.At(present.body, pose, present.things).Sum();
  if (start > present.fitness.Sum() + kOdds.hopeless_nats) return;
  if (removed_.empty()) {
    removed_.push_back(present);
  } else {
    removed_.back() = present;
  }
  Hypothesis offered = std::move(removed_.back());
  removed_.pop_back();
  offered.Jump(objective, pose);
  offered.nats += NatsOf(offered.fitness) - NatsOf(present.fitness);
  if (offered.nats < present.nats) {
    for (Hypothesis& one : hypotheses_)
      if (AreSame(one, present)) one.trials = 0;
    present.trials = 0;
  } else {
    offered.trials = 0;
  }
  Offer(std::move(offered));
}

void HypothesisSet::Offer(Hypothesis hypothesis) {
  if (!hypothesis.filter.is_sound()) return;
  const auto is_same = [&](const Hypothesis& other) { return AreSame(hypothesis, other); };
  const auto known = std::ranges::find_if(hypotheses_, is_same);
  if (known == hypotheses_.end()) {
    hypotheses_.push_back(std::move(hypothesis));
  } else {
    if (hypothesis.fitness.Sum() < known->fitness.Sum() &&
        FramesOf(hypothesis) >= FramesOf(*known)) {
      std::swap(*known, hypothesis);
      // What spoke against the pose so far still does.
      std::swap(known->nats, hypothesis.nats);
    }
    Keep(std::move(hypothesis));
  }
  Judge();
}

void HypothesisSet::Judge() {
  Merge();
  const auto likeliest = std::ranges::min_element(hypotheses_, {}, &Hypothesis::nats);
  if (likeliest->nats < best().nats - std::log(kOdds.change)) {
    std::iter_swap(hypotheses_.begin(), likeliest);
    ++changes_;
  }
  Drop();
}

// Of two that are the same pose, the likelier stays in the place of the first.
void HypothesisSet::Merge() {
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    for (std::size_t j = hypotheses_.size() - 1; j > i; --j) {
      Hypothesis &a = hypotheses_[i], &b = hypotheses_[j];
      if (!AreSame(a, b)) continue;
      if (b.nats < a.nats) std::swap(a, b);
      Remove(j);
    }
  }
}

void HypothesisSet::Drop() {
  std::sort(hypotheses_.begin() + 1, hypotheses_.end(),
            [](const Hypothesis& a, const Hypothesis& b) {
              return std::pair(a.trials == 0, a.nats) < std::pair(b.trials == 0, b.nats);
            });
  while (hypotheses_.size() > kOdds.most) Remove(hypotheses_.size() - 1);
  const double likeliest = std::ranges::min_element(hypotheses_, {}, &Hypothesis::nats)->nats;
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.nats -= likeliest;
  for (std::size_t i = hypotheses_.size() - 1; i > 0; --i) {
    const Hypothesis& one = hypotheses_[i];
    const bool is_improbable = one.trials == 0 && one.nats > std::log(kOdds.drop);
    if (is_improbable || !one.filter.is_sound()) Remove(i);
  }
}

void HypothesisSet::Keep(Hypothesis removed) {
  if (removed_.size() < kOdds.most) removed_.push_back(std::move(removed));
}

void HypothesisSet::Remove(std::size_t i) {
  Keep(std::move(hypotheses_[i]));
  hypotheses_.erase(hypotheses_.begin() + static_cast<std::ptrdiff_t>(i));
}

double HypothesisSet::ProbabilityOf(const Hypothesis& one) const {
  double sum = 0;
  for (const Hypothesis& other : hypotheses_) sum += std::exp(one.nats - other.nats);
  return 1 / sum;
}

const Hypothesis* HypothesisSet::Rival() const {
  const auto others = std::span(hypotheses_).subspan(1);
  return others.empty() ? nullptr : &*std::ranges::min_element(others, {}, &Hypothesis::nats);
}

}  // namespace mocap

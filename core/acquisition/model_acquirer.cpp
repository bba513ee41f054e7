#include "core/acquisition/model_acquirer.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/acquisition/first_fit.h"
#include "core/acquisition/size_fit.h"

namespace mocap {
namespace {

// Hair and soles, which a silhouette shows and a stadiometer does not.
constexpr double kHairAndSolesMm = 25;
// A first fit is no body at all when it costs more, or when its bones lie so far from any flesh.
constexpr double kWorstCostMm = 34;
constexpr double kMostHollowMm = 22;
constexpr double kSettledMm = 3;         // §8.1
constexpr double kClearlyBetter = 1.12;  // of two facings
constexpr int kFramesToDecide = 6;

// What the network takes as evidence, and what is measured well enough to be believed as it is.
constexpr std::array<SizeMember, 3> kWidths = {&BodySizes::head_width, &BodySizes::shoulder_width,
                                               &BodySizes::neck};
constexpr std::array<SizeMember, 13> kMeasured = {&BodySizes::thigh,
                                                  &BodySizes::calf,
                                                  &BodySizes::upper_arm,
                                                  &BodySizes::lower_arm,
                                                  &BodySizes::torso_width,
                                                  &BodySizes::torso_depth,
                                                  &BodySizes::head_width,
                                                  &BodySizes::upper_arm_width,
                                                  &BodySizes::lower_arm_width,
                                                  &BodySizes::thigh_width,
                                                  &BodySizes::calf_width,
                                                  &BodySizes::shoulder_width,
                                                  &BodySizes::neck};

// Widths differ among people by some 10 % (ANSUR, Gordon et al. 1989), and clothes, hulls and what
// touches a part make them err as much: of one width alone half is believed. Of those that go
// together their mean is believed more, and what one differs from the others less.
constexpr double kMeasuredShare = 0.5;
constexpr double kMeanVariance =
    1 + kWidthCorrelation * (static_cast<double>(kStoutWidths.size()) - 1);
constexpr double kMeasuredMeanShare = kMeanVariance / (kMeanVariance + 1);
constexpr double kMeasuredOwnShare = (1 - kWidthCorrelation) / (1 - kWidthCorrelation + 1);

// The statures that are tried, as shares of the height: of somebody who sits, crouches or jumps it
// says little.
constexpr std::array<double, 6> kStatures = {1, 1.12, 0.89, 1.25, 0.8, 1.4};
constexpr int kStaturesPerFrame = 2;
constexpr double kSmallestMm = 1000;
constexpr double kLargestMm = 2100;
// What costs no more needs no other stature.
constexpr double kGoodCostMm = 30;

double CostOf(const std::vector<Tracker>& found) {
  const bool is_body = !found.empty() && found.front().quality().hollow_mm < kMostHollowMm;
  return is_body ? found.front().quality().Cost() : std::numeric_limits<double>::infinity();
}

// Sets the widths that go together.
void BelieveStoutness(const BodySizes& average, const BodySizes& measured, BodySizes& sizes) {
  double stoutness = 0;
  for (const SizeMember width : kStoutWidths) {
    stoutness += (measured.*width / (average.*width) - 1) / kStoutWidths.size();
  }
  for (const SizeMember width : kStoutWidths) {
    const double own = measured.*width / (average.*width) - 1 - stoutness;
    sizes.*width = average.*width * (1 + kMeasuredMeanShare * stoutness + kMeasuredOwnShare * own);
  }
}

double HeightOf(const VoxelCloud& cloud) {
  double height_mm = 0;
  for (const Voxel& voxel : cloud.voxels()) height_mm = std::max(height_mm, voxel.center_W.z());
  return height_mm;
}

}  // namespace

bool ModelAcquirer::Locate(const Evidence& evidence, const std::optional<BodySizes>& known) {
  if (known) {
    const std::optional<LocalizedBody> located = LocalizeBody(evidence.cloud, CrustOf(*known));
    if (!located) return false;
    const std::vector<Tracker> found =
        FitBody(BodyModel(table_, *known), evidence, *located, TrunkSize::kGiven);
    if (CostOf(found) > kWorstCostMm) return false;
    Begin(found, evidence);
    for (Hypothesis& hypothesis : hypotheses_) hypothesis.tracker.Resize(*known);
    settled_ = true;
    return true;
  }
  for (int i = 0; i < kStaturesPerFrame; ++i) {
    if (TryStature(evidence)) return true;
  }
  return false;
}

bool ModelAcquirer::TryStature(const Evidence& evidence) {
  // After all of them comes the likeliest again.
  const bool is_last = next_stature_ == std::ssize(kStatures);
  const double share = is_last ? likely_stature_ : kStatures[next_stature_];
  next_stature_ = is_last ? 0 : next_stature_ + 1;
  if (next_stature_ == 1) likely_cost_mm_ = kWorstCostMm;
  const HeadCrust crust = CrustOf(AverageSizes(share * HeightOf(evidence.cloud)));
  const std::optional<LocalizedBody> located = LocalizeBody(evidence.cloud, crust);
  if (!located) return false;
  height_mm_ = located->height_mm - kHairAndSolesMm;
  const double stature_mm = share * height_mm_;
  if (stature_mm < kSmallestMm || stature_mm > kLargestMm) return false;
  const std::vector<Tracker> found = FitBody(BodyModel(table_, AverageSizes(stature_mm)), evidence,
                                             *located, TrunkSize::kMeasured);
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
  for (const SizeMember size : kMeasured) {
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
  const BodySizes average = AverageSizes(sizes.Stature());
  for (const SizeMember width : kWidths) {
    sizes.*width = average.*width + kMeasuredShare * (mean.*width - average.*width);
  }
  BelieveStoutness(average, mean, sizes);
  // The joints lie too deep within flesh to be measured in a few frames.
  sizes.hip_width = average.hip_width;
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
  // Somebody who crouches leaves lengths open: what tracking shows of them is taken in later.
  const bool at_rest = frames_ > 1 && (change_mm < kSettledMm || frames_ >= kFramesToDecide);
  settled_ = hypotheses_.size() == 1 && at_rest;
}

}  // namespace mocap

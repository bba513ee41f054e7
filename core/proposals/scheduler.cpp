#include "core/proposals/scheduler.h"

#include <algorithm>
#include <cmath>

#include "core/proposals/keypoint_proposals.h"

namespace mocap {
namespace {

// What may be spent, and where it goes.
struct Budget {
  double per_s = 3000;      // Evaluations of the objective per second of capture time,
  double most_saved = 500;  // and the most that are saved up.
  // Searches after the first, within about the time there is.
  double searches_per_s = 9, least_effort = 0.1;
  // A round is worth its cost from this share of rays on that no part explains. Rests double
  // between these limits as long as rounds are in vain.
  double unexplained_share = 0.005, shortest_rest_s = 0.1, longest_rest_s = 0.4;
  // Candidates of a search that are tracked with all limbs: at full effort, and otherwise.
  std::size_t finalists = 3, few_finalists = 1;
  // Of poses within 40 mm of the truth, one in a hundred has a greater misfit.
  double doubtful_misfit = 0.26;
};
constexpr Budget kBudget{};
// The steps of a round: each limb, both arms, both legs, whole stances.
constexpr std::size_t kBothArms = kLimbEnds.size();
constexpr std::size_t kWholeStances = kBothArms + kLimbPairs.size();

bool IsExplained(const Fitness& fitness) {
  return fitness.unexplained_share < kBudget.unexplained_share;
}

// Whether a share of the rays has grown by more than the noise of independent rays.
bool IsClearlyMore(double share, double before) {
  const double std = std::sqrt(before * (1 - before) / kIndependentRays);
  return share > before + kBudget.unexplained_share + 2 * std;
}

}  // namespace

double EffortWithin(double dt_s) {
  return std::clamp(kBudget.searches_per_s * dt_s, kBudget.least_effort, 1.0);
}

void Scheduler::StartOver() {
  strangers_.StartOver();
  acquainted_.reset();
  BeginRounds();
}

void Scheduler::BeginRounds() {
  next_ = 0;
  allowance_ = rest_s_ = rest_after_s_ = vain_share_ = 0;
}

StanceSearch& Scheduler::SearchFor(const std::optional<BodySizes>& known) {
  if (!known) return strangers_;
  if (!acquainted_ || !(acquainted_->body(0).sizes() == *known))
    acquainted_.emplace(BodyModel(table_, *known));
  return *acquainted_;
}

std::vector<Hypothesis> Scheduler::FindAnybody(Objective& objective,
                                               const std::optional<BodySizes>& known,
                                               const SearchScope& scope) {
  StanceSearch& search = SearchFor(known);
  const std::vector<StanceCandidate>& candidates = search.Find(objective, scope);
  const std::size_t finalists =
      std::min(candidates.size(), scope.effort < 1 ? kBudget.few_finalists : kBudget.finalists);
  std::vector<Hypothesis> found;
  for (std::size_t i = 0; i < finalists; ++i) {
    Hypothesis& hypothesis =
        found.emplace_back(search.body(candidates[i].body), candidates[i].pose, !known);
    hypothesis.things = candidates[i].things;
    hypothesis.trials = static_cast<int>(kWholeStances);
    hypothesis.Fit(objective);
    if (!known) hypothesis.MeasureSizes(objective);
  }
  std::ranges::stable_sort(found, {}, [](const Hypothesis& one) { return one.fitness.Sum(); });
  if (!found.empty()) search.Remember(found.front().body.sizes(), found.front().filter.pose());
  return found;
}

void Scheduler::TryLimbs(std::size_t which, Objective& objective, const Hypothesis& present,
                         HypothesisSet& hypotheses) {
  varied_ = present;
  poses_.clear();
  if (which < kLimbEnds.size()) {
    limbs_.Elsewhere(objective, *varied_, kLimbEnds[which], poses_);
  } else {
    limbs_.Both(objective, *varied_, kLimbPairs[which - kBothArms], poses_);
  }
  for (const PoseState& pose : poses_) hypotheses.Vary(objective, *varied_, pose);
}

void Scheduler::TryKeypoints(Objective& objective, HypothesisSet& hypotheses) {
  const auto& views = objective.evidence().recent_keypoints;
  if (views.empty()) return;
  varied_ = hypotheses.best();
  if (const auto pose = ProposeByKeypoints(objective, *varied_, views))
    hypotheses.Vary(objective, *varied_, *pose);
}

bool Scheduler::TryNewcomer(Objective& objective, HypothesisSet& hypotheses) {
  const auto is_on_trial = [](const Hypothesis& one) { return one.trials > 0; };
  const auto newcomer = std::ranges::find_if(hypotheses.all(), is_on_trial);
  if (newcomer == hypotheses.all().end()) return false;
  const std::size_t which = kWholeStances - newcomer->trials--;
  // Arms that explain everything may still be each other's.
  const bool is_worth_it = !IsExplained(newcomer->fitness) || which == kBothArms;
  if (is_worth_it) TryLimbs(which, objective, *newcomer, hypotheses);
  return true;
}

void Scheduler::TryStances(Objective& objective, HypothesisSet& hypotheses, bool sizes_are_known,
                           double dt_s) {
  const Hypothesis believed = hypotheses.best();
  const std::optional<BodySizes> known =
      sizes_are_known ? std::optional(believed.body.sizes()) : std::nullopt;
  for (Hypothesis& found : FindAnybody(objective, known, {EffortWithin(dt_s), believed.things})) {
    if (sizes_are_known) found.sizes = believed.sizes;
    const Hypothesis& best = hypotheses.best();
    found.nats = best.nats + hypotheses.NatsOf(found.fitness) - hypotheses.NatsOf(best.fitness);
    hypotheses.Offer(found);
  }
}

void Scheduler::Try(Objective& objective, HypothesisSet& hypotheses, bool sizes_are_known,
                    double dt_s) {
  rest_s_ -= dt_s;
  allowance_ = std::min(allowance_ + kBudget.per_s * dt_s, kBudget.most_saved);
  TryKeypoints(objective, hypotheses);
  while (allowance_ > 0) {
    const double before = objective.evaluations();
    if (!TryNewcomer(objective, hypotheses) && !GoOn(objective, hypotheses, sizes_are_known, dt_s))
      return;
    allowance_ -= objective.evaluations() - before;
  }
}

bool Scheduler::GoOn(Objective& objective, HypothesisSet& hypotheses, bool sizes_are_known,
                     double dt_s) {
  const Fitness fitness = hypotheses.best().fitness;
  if (rest_s_ > 0 && !IsClearlyMore(fitness.unexplained_share, vain_share_)) return false;
  const bool is_doubtful = fitness.misfit > kBudget.doubtful_misfit || fitness.backwards > 0.5;
  if (next_ < kWholeStances && !IsExplained(fitness))
    TryLimbs(next_, objective, hypotheses.best(), hypotheses);
  if (next_ == kWholeStances && is_doubtful)
    TryStances(objective, hypotheses, sizes_are_known, dt_s);
  if (next_++ < kWholeStances) return true;
  next_ = 0;
  const bool was_in_vain = hypotheses.changes() == changes_before_;
  changes_before_ = hypotheses.changes();
  vain_share_ = fitness.unexplained_share;
  rest_after_s_ =
      was_in_vain ? std::clamp(2 * rest_after_s_, kBudget.shortest_rest_s, kBudget.longest_rest_s)
                  : kBudget.shortest_rest_s;
  rest_s_ = rest_after_s_;
  return true;
}

}  // namespace mocap

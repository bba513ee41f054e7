#include "core/solving/hypothesis_run.h"

#include <algorithm>
#include <utility>

#include "core/counted_time.h"
#include "core/hypotheses/hypothesis_set.h"
#include "core/proposals/scheduler.h"

namespace mocap {
namespace {

struct RunLimits {
  double least_litres = 12;   // As live.
  double forget_after_s = 1;  // Since the evidence ended or the fit was lost.
};
constexpr RunLimits kRun{};

class HypothesisRun {
 public:
  HypothesisRun(RecordedSets& sets, PersonEvidence& evidence)
      : sets_(sets), evidence_(evidence), scheduler_(evidence.track().body.table()) {}

  Candidates Step(int set, double dt_s) {
    sets_.Read(set, recorded_);
    const std::optional<PoseState> pose = ExpectedPose(set, dt_s);
    const Evidence& evidence = evidence_.In(recorded_, set, pose ? &*pose : nullptr);
    lost_s_ += CountedS(dt_s);
    waited_s_ += dt_s;
    if (evidence.cloud.volume_litres() >= kRun.least_litres) {
      objective_.SetEvidence(evidence);
      if (hypotheses_.empty()) {
        Begin(set);
      } else {
        Follow();
      }
    }
    if (lost_s_ >= kRun.forget_after_s) Forget();
    return lost_s_ > 0 ? Candidates() : Present();
  }

 private:
  std::optional<PoseState> ExpectedPose(int set, double dt_s) const {
    if (!hypotheses_.empty()) return hypotheses_.best().filter.PredictedPose(waited_s_ + dt_s);
    const PoseState* const known = evidence_.track().At(set);
    return known ? std::optional(*known) : std::nullopt;
  }

  void Begin(int set) {
    std::vector<Hypothesis> found = FindAt(set);
    std::erase_if(found, [](const Hypothesis& one) { return !one.fitness.IsCredible(); });
    if (found.empty()) return;
    std::ranges::stable_sort(found, {}, [](const Hypothesis& one) { return one.fitness.Sum(); });
    hypotheses_.Begin(std::move(found), objective_.evidence().cloud.Centroid());
    scheduler_.BeginRounds();
    lost_s_ = waited_s_ = 0;
  }

  void Follow() {
    const double dt_s = std::exchange(waited_s_, 0);
    hypotheses_.Follow(objective_, dt_s);
    scheduler_.Try(objective_, hypotheses_, true, dt_s);
    const Hypothesis& best = hypotheses_.best();
    if (!best.fitness.IsLost() && best.filter.is_sound()) lost_s_ = 0;
  }

  // The pose of live tracking, where there is one: a search of the whole room may find a worse one
  // that explains a single set better.
  std::vector<Hypothesis> FindAt(int set) {
    const PersonTrack& track = evidence_.track();
    const PoseState* const known = track.At(set);
    if (!known) return scheduler_.FindAnybody(objective_, track.body.sizes(), {});
    Hypothesis hypothesis(track.body, *known, false);
    hypothesis.things = kAnyThings;
    hypothesis.Fit(objective_);
    return {hypothesis};
  }

  void Forget() {
    hypotheses_.Clear();
    scheduler_.StartOver();
    lost_s_ = 0;
  }

  Candidates Present() const {
    Candidates candidates;
    for (const Hypothesis& one : hypotheses_.all())
      candidates.push_back({one.filter.pose(), one.fitness.Sum(), one.fitness.things});
    return candidates;
  }

  RecordedSets& sets_;
  PersonEvidence& evidence_;
  Scheduler scheduler_;
  Objective objective_;
  HypothesisSet hypotheses_;
  RecordedSet recorded_;
  double lost_s_ = 0;    ///< Since the last set that was explained.
  double waited_s_ = 0;  ///< Since the last set with evidence.
};

}  // namespace

std::vector<Candidates> FollowHypotheses(RecordedSets& sets, const RunOver& run,
                                         PersonEvidence& evidence) {
  HypothesisRun follower(sets, evidence);
  std::vector<Candidates> candidates;
  for (int step = 0; step < run.count(); ++step) {
    const double dt_s = step == 0 ? 0 : TimeBetween_s(sets, run.at(step - 1), run.at(step));
    candidates.push_back(follower.Step(run.at(step), dt_s));
  }
  return candidates;
}

}  // namespace mocap

#include "core/solving/take_sizes.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/hypotheses/hypothesis_set.h"

namespace mocap {
namespace {

struct Measuring {
  int sets = 300;  // Live, 90 do.
  int rounds = 3;  // As in a search.
};
constexpr Measuring kMeasuring{};

// Sets of a path with a pose, evenly spread.
std::vector<int> SpreadOver(std::span<const PathStep> path) {
  std::vector<int> posed;
  for (std::size_t i = 0; i < path.size(); ++i)
    if (path[i].pose) posed.push_back(static_cast<int>(i));
  const int count = static_cast<int>(posed.size()), wanted = std::min(count, kMeasuring.sets);
  std::vector<int> spread;
  for (int i = 0; i < wanted; ++i)
    spread.push_back(posed[static_cast<std::size_t>(std::int64_t{i} * count / wanted)]);
  return spread;
}

// The lengths that are usual for somebody's stature, and the person's widths: what is measured
// anew must not count twice.
BodySizes UsualFor(const BodySizes& sizes) {
  const BodySizes usual = AverageSizes(sizes.Stature());
  BodySizes start = sizes;
  for (const SizeMember length :
       {&BodySizes::torso, &BodySizes::head, &BodySizes::neck, &BodySizes::upper_arm,
        &BodySizes::lower_arm, &BodySizes::thigh, &BodySizes::calf, &BodySizes::shoulder_width})
    start.*length = usual.*length;
  return start;
}

}  // namespace

Things ThingsOf(std::span<const PathStep> path) {
  std::array<int, kThingCount> sets{};
  int posed = 0;
  for (const PathStep& step : path) {
    posed += step.pose.has_value();
    for (std::size_t i = 0; i < sets.size(); ++i) sets[i] += step.things[i];
  }
  Things things;
  for (std::size_t i = 0; i < sets.size(); ++i) things[i] = 2 * sets[i] > posed;
  return things;
}

BodySizes MeasureOver(RecordedSets& sets, int first, std::span<const PathStep> path,
                      PersonEvidence& evidence) {
  const std::vector<int> spread = SpreadOver(path);
  if (spread.empty()) return evidence.track().body.sizes();
  const Things things = ThingsOf(path);
  Hypothesis person(evidence.track().body, *path[spread.front()].pose, true);
  const BodyModel start(person.body.table(), UsualFor(person.body.sizes()));
  std::vector<PoseState> poses;
  for (const int i : spread) poses.push_back(*path[i].pose);
  const double whole_s = TimeBetween_s(sets, first + spread.front(), first + spread.back());
  const double worth = FrameWorth(whole_s / static_cast<double>(spread.size()));
  Objective objective;
  RecordedSet recorded;
  for (int round = 0; round < kMeasuring.rounds; ++round) {
    SizeRefiner refiner(start);
    for (std::size_t i = 0; i < spread.size(); ++i) {
      const int set = first + spread[i];
      sets.Read(set, recorded);
      objective.SetEvidence(evidence.In(recorded, set, &poses[i]));
      person.things = things;
      person.Jump(objective, poses[i]);
      if (!person.filter.is_sound() || !person.fitness.IsCredible()) continue;
      poses[i] = person.filter.pose();
      refiner.Add(person.body, objective, poses[i], worth);
    }
    person.body.Resize(refiner.Sizes());
  }
  return person.body.sizes();
}

}  // namespace mocap

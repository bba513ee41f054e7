#include "tools/accuracy/first_sets.h"

#include <algorithm>

#include "core/degrees.h"
#include "core/errors.h"

namespace mocap {
namespace {

std::int64_t TrackedOf(const ErrorsBySet& run, std::span<const std::int64_t> wanted) {
  return std::ranges::count_if(wanted, [&run](std::int64_t set) { return run.contains(set); });
}

/// The wanted sets that all runs track, except those that track none of them.
std::vector<std::int64_t> CommonSets(std::span<const ErrorsBySet> runs,
                                     std::span<const std::int64_t> wanted) {
  std::vector<std::int64_t> common(wanted.begin(), wanted.end());
  bool is_tracked = false;
  for (const ErrorsBySet& run : runs) {
    if (TrackedOf(run, wanted) == 0) continue;
    is_tracked = true;
    std::erase_if(common, [&run](std::int64_t set) { return !run.contains(set); });
  }
  if (!is_tracked) common.clear();
  return common;
}

std::optional<PoseErrors> ErrorsIn(const ErrorsBySet& run, std::span<const std::int64_t> sets) {
  if (sets.empty()) return std::nullopt;
  std::vector<double> distances_mm;
  double angle_rad = 0;
  for (const std::int64_t set : sets) {
    const FrameError& error = run.at(set);
    distances_mm.insert(distances_mm.end(), error.point_mm.begin(), error.point_mm.end());
    angle_rad += error.angle_rad.mean() / static_cast<double>(sets.size());
  }
  const DistanceSummary distance_mm = SummarizeDistances(std::move(distances_mm));
  return PoseErrors{distance_mm.mean, distance_mm.p95, angle_rad * kDegreesPerRad};
}

}  // namespace

std::optional<PoseErrors> PersonScore::Mean() const {
  PoseErrors sum;
  int runs = 0;
  for (const FirstScore& first : firsts) {
    if (!first.errors) continue;
    sum.mean_mm += first.errors->mean_mm;
    sum.p95_mm += first.errors->p95_mm;
    sum.angle_deg += first.errors->angle_deg;
    ++runs;
  }
  if (runs == 0) return std::nullopt;
  return PoseErrors{sum.mean_mm / runs, sum.p95_mm / runs, sum.angle_deg / runs};
}

double PersonScore::tracked_share() const {
  double sum = 0;
  for (const FirstScore& first : firsts) sum += first.tracked_share;
  return firsts.empty() ? 0 : sum / static_cast<double>(firsts.size());
}

double PersonScore::spread_mm() const {
  std::optional<double> least, most;
  for (const FirstScore& first : firsts) {
    if (!first.errors) continue;
    least = std::min(least.value_or(first.errors->mean_mm), first.errors->mean_mm);
    most = std::max(most.value_or(first.errors->mean_mm), first.errors->mean_mm);
  }
  return most ? *most - *least : 0;
}

PersonScore ScoreFirsts(std::span<const ErrorsBySet> runs, std::span<const std::int64_t> wanted) {
  MOCAP_CHECK(!wanted.empty());
  const std::vector<std::int64_t> common = CommonSets(runs, wanted);
  PersonScore score{.firsts = {}, .sets = static_cast<int>(common.size())};
  for (const ErrorsBySet& run : runs) {
    const std::int64_t tracked = TrackedOf(run, wanted);
    score.firsts.push_back({tracked > 0 ? ErrorsIn(run, common) : std::nullopt,
                            static_cast<double>(tracked) / static_cast<double>(wanted.size())});
  }
  return score;
}

}  // namespace mocap

#include "tools/accuracy/first_sets.h"

#include <algorithm>

#include "core/degrees.h"
#include "core/errors.h"

namespace mocap {
namespace {

std::vector<std::int64_t> CommonSets(std::span<const ErrorsBySet> runs) {
  const auto first = std::ranges::find_if(runs, [](const auto& run) { return !run.empty(); });
  std::vector<std::int64_t> common;
  if (first == runs.end()) return common;
  for (const auto& [set, error] : *first) {
    const bool is_common = std::ranges::all_of(
        runs, [set](const ErrorsBySet& run) { return run.empty() || run.contains(set); });
    if (is_common) common.push_back(set);
  }
  return common;
}

std::optional<PoseErrors> ErrorsIn(const ErrorsBySet& run, std::span<const std::int64_t> sets) {
  if (run.empty() || sets.empty()) return std::nullopt;
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
  const std::vector<std::int64_t> common = CommonSets(runs);
  PersonScore score{.firsts = {}, .sets = static_cast<int>(common.size())};
  for (const ErrorsBySet& run : runs) {
    const auto tracked =
        std::ranges::count_if(wanted, [&run](std::int64_t set) { return run.contains(set); });
    score.firsts.push_back(
        {ErrorsIn(run, common), static_cast<double>(tracked) / static_cast<double>(wanted.size())});
  }
  return score;
}

}  // namespace mocap

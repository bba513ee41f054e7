#include "tools/comparison/alignment.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/quantile.h"
#include "tools/comparison/speed_correlation.h"

namespace mocap {
namespace {

/// Enough to weigh offsets.
constexpr std::size_t kSomeMoments = 300;
constexpr std::size_t kMostOffsets = 12;

/// The middle of several markers.
std::vector<Vector3> MiddleOf(const RecordedMotion& other, const std::vector<std::string>& names) {
  std::vector<Vector3> middle(other.time_s.size(), Vector3::Zero());
  for (const std::string& name : names) {
    const PointTrack* track = other.FindPoint(name);
    if (track == nullptr) return {};
    for (std::size_t i = 0; i < middle.size(); ++i)
      middle[i] += track->p_mm[i] / static_cast<double>(names.size());
  }
  return middle;
}

/// The first pair of each point.
std::vector<PointPair> FirstOfEach(const std::vector<PointPair>& pairs) {
  std::vector<PointPair> first;
  for (const PointPair& pair : pairs)
    if (std::ranges::find(first, pair.point, &PointPair::point) == first.end())
      first.push_back(pair);
  return first;
}

/// Leaves each marker to the nearest of the points that its name may mean.
void ResolveByDistance(const ResultMotion& own, const RecordedMotion& other, Alignment& alignment) {
  const PairedPlaces all = PlacesAt(own, other, alignment, kSomeMoments);
  std::vector<std::vector<double>> distances(alignment.pairs.size());
  for (std::size_t i = 0; i < all.places.size(); ++i)
    distances[all.pair[i]].push_back(
        (alignment.X * all.places[i].other - all.places[i].own).norm());
  std::map<std::vector<std::string>, std::pair<double, std::size_t>> nearest;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i].empty()) continue;
    const std::pair<double, std::size_t> here{MedianOf(distances[i]), i};
    const auto [place, is_new] = nearest.emplace(alignment.pairs[i].others, here);
    if (!is_new) place->second = std::min(place->second, here);
  }
  std::vector<bool> stays(distances.size());
  for (const auto& [names, best] : nearest) stays[best.second] = true;
  std::vector<PointPair> kept;
  for (std::size_t i = 0; i < stays.size(); ++i)
    if (stays[i]) kept.push_back(std::move(alignment.pairs[i]));
  alignment.pairs = std::move(kept);
}

std::vector<SignalPair> SpeedsOf(const ResultMotion& own, const RecordedMotion& other,
                                 const std::vector<PointPair>& pairs, double step_s) {
  const TimeGrid own_grid = GridOf(own.motion, step_s), other_grid = GridOf(other, step_s);
  std::vector<SignalPair> speeds;
  for (const PointPair& pair : pairs) {
    speeds.push_back({SpeedOf(Resampled(own.motion, {pair.point, *pair.own}, own_grid), step_s),
                      SpeedOf(Resampled(other, {pair.point, pair.other}, other_grid), step_s)});
  }
  return speeds;
}

}  // namespace

double CoarseStep(const RecordedMotion& own, const RecordedMotion& other) {
  constexpr double kFinest_s = 1.0 / 30;
  return std::max({kFinest_s, own.Period(), other.Period()});
}

std::size_t LeastOverlap(const RecordedMotion& own, const RecordedMotion& other, double step_s) {
  const double shorter_s = std::min(own.Seconds(), other.Seconds());
  const double least_s = std::max(shorter_s / 4, std::min(1.0, 0.8 * shorter_s));
  return std::max<std::size_t>(3, static_cast<std::size_t>(least_s / step_s));
}

std::vector<PointPair> PairsOf(const ResultMotion& own, const RecordedMotion& other,
                               std::span<const NamedPair> names) {
  std::vector<PointPair> pairs;
  for (const NamedPair& named : names) {
    const PointTrack* track = own.motion.FindPoint(named.point);
    PointPair pair{named.point, named.others, nullptr, MiddleOf(other, named.others),
                   ResultMotion::SegmentOf(named.point)};
    const bool is_seen =
        std::ranges::any_of(pair.other, [](const Vector3& p) { return p.allFinite(); });
    if (track == nullptr || !is_seen) continue;
    pair.own = &track->p_mm;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::optional<Alignment> AlignByNames(const ResultMotion& own, const RecordedMotion& other,
                                      const std::vector<NamedPair>& names) {
  Alignment alignment;
  alignment.pairs = FirstOfEach(PairsOf(own, other, names));
  if (alignment.pairs.size() < 3) return {};
  const double step_s = CoarseStep(own.motion, other);
  const double start_s = own.motion.time_s.front() - other.time_s.front();
  std::optional<Alignment> best;
  for (const OffsetCandidate& candidate :
       FindOffsets(SpeedsOf(own, other, alignment.pairs, step_s),
                   LeastOverlap(own.motion, other, step_s), kMostOffsets)) {
    alignment.offset_s = start_s + step_s * candidate.lag;
    const PairedPlaces all = PlacesAt(own, other, alignment, kSomeMoments);
    const auto fit = FitRobustly(all.places);
    // Steps of a walk are alike: a weaker correlation must fit clearly better.
    constexpr double kClearly = 0.9;
    if (!fit || (best && fit->median_mm > kClearly * best->median_mm)) continue;
    best = alignment;
    best->X = fit->X;
    best->median_mm = fit->median_mm;
  }
  if (!best) return {};
  ResolveByDistance(own, other, *best);
  return Refined(own, other, std::move(*best), 2 * step_s);
}

}  // namespace mocap

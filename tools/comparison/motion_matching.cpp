// Pairs points of two recordings without their names.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "tools/comparison/alignment.h"
#include "tools/comparison/speed_correlation.h"

namespace mocap {
namespace {

constexpr std::size_t kMostOffsetsByMotion = 12, kMatchingMoments = 40;
/// A marker on the skin is nearer to the bone than this; what is farther off is something else.
constexpr double kFarthest_mm = 150;
/// Rough equality of distances between points and between markers beside them [mm].
constexpr double kAlikeApart_mm = 80, kLeastApart_mm = 150;
constexpr int kTriples = 400, kDraws = 20'000, kLikeliest = 4;

/// Places of tracks at some moments: by track, then by moment.
using Places = std::vector<std::vector<Vector3>>;

struct Scene {
  Places own, other;
  std::vector<std::vector<std::size_t>> likely;  ///< By other track: own ones, the likeliest first.
};

/// Speeds of all tracks of a recording, sampled at even times.
struct SampledTracks {
  TimeGrid grid;
  Places places;
  std::vector<Signal> speeds;

  SampledTracks(const RecordedMotion& motion, double step_s) : grid(GridOf(motion, step_s)) {
    for (const PointTrack& track : motion.points) {
      places.push_back(Resampled(motion, track, grid));
      speeds.push_back(SpeedOf(places.back(), step_s));
    }
  }
};

/// How unequal the speeds of an own and another track are: 0 alike, 1 not at all.
double UnlikenessOf(const Signal& own, const Signal& other, std::ptrdiff_t lag) {
  double apart = 0, own_sum = 0, other_sum = 0;
  for (std::size_t i = 0; i < other.size(); ++i) {
    const std::ptrdiff_t k = static_cast<std::ptrdiff_t>(i) + lag;
    if (k < 0 || k >= std::ssize(own)) continue;
    const double a = own[static_cast<std::size_t>(k)], b = other[i];
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    apart += (a - b) * (a - b);
    own_sum += a * a;
    other_sum += b * b;
  }
  return own_sum + other_sum > 0 ? std::sqrt(apart / (own_sum + other_sum)) : 1;
}

Scene SceneAt(const SampledTracks& own, const SampledTracks& other, std::ptrdiff_t lag) {
  Scene scene;
  std::vector<std::size_t> moments;
  for (std::size_t i = 0; i < other.grid.count; ++i) {
    const std::ptrdiff_t k = static_cast<std::ptrdiff_t>(i) + lag;
    if (k >= 0 && k < static_cast<std::ptrdiff_t>(own.grid.count)) moments.push_back(i);
  }
  const std::size_t count = std::min(moments.size(), kMatchingMoments);
  const auto sample = [&](const Places& places, std::ptrdiff_t shift) {
    Places sampled(places.size());
    for (std::size_t t = 0; t < places.size(); ++t)
      for (std::size_t k = 0; k < count; ++k)
        sampled[t].push_back(places[t][static_cast<std::size_t>(
            static_cast<std::ptrdiff_t>(moments[k * moments.size() / count]) + shift)]);
    return sampled;
  };
  scene.own = sample(own.places, lag);
  scene.other = sample(other.places, 0);
  for (const Signal& speed : other.speeds) {
    std::vector<double> unlike;
    for (const Signal& own_speed : own.speeds)
      unlike.push_back(UnlikenessOf(own_speed, speed, lag));
    auto& likely = scene.likely.emplace_back(unlike.size());
    for (std::size_t i = 0; i < likely.size(); ++i) likely[i] = i;
    std::ranges::stable_sort(likely, {}, [&](std::size_t i) { return unlike[i]; });
    likely.resize(std::min<std::size_t>(likely.size(), kLikeliest));
  }
  return scene;
}

/// Mean distance of two tracks under a transform; infinite: never seen together.
double MeanApart(const std::vector<Vector3>& own, const std::vector<Vector3>& other,
                 const RigidTransform& X) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const double apart = (X * other[i] - own[i]).norm();
    if (!std::isfinite(apart)) continue;
    sum += apart;
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::infinity();
}

using Triple = std::array<std::pair<std::size_t, std::size_t>, 3>;  ///< Own track, other track.

/// Whether points of a triple are as far apart in both recordings, and far enough to show a turn.
bool IsAlikeApart(const Scene& scene, const Triple& triple) {
  for (const auto& [a, b] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
    const RigidTransform none;
    const auto apart = [&](const Places& places, std::size_t i, std::size_t k) {
      return MeanApart(places[i], places[k], none);
    };
    const auto& [own_a, other_a] = triple[static_cast<std::size_t>(a)];
    const auto& [own_b, other_b] = triple[static_cast<std::size_t>(b)];
    const double own = apart(scene.own, own_a, own_b), other = apart(scene.other, other_a, other_b);
    if (!(own > kLeastApart_mm) || !(std::abs(own - other) < kAlikeApart_mm)) return false;
  }
  return true;
}

std::vector<PlacePair> PlacesOf(const Scene& scene,
                                std::span<const std::pair<std::size_t, std::size_t>> pairs) {
  std::vector<PlacePair> places;
  for (const auto& [own, other] : pairs)
    for (std::size_t i = 0; i < scene.own[own].size(); ++i)
      if (scene.own[own][i].allFinite() && scene.other[other][i].allFinite())
        places.push_back({scene.other[other][i], scene.own[own][i]});
  return places;
}

/// Sum of the distances from every other track to the nearest own one, at most kFarthest_mm each.
double CostOf(const Scene& scene, const RigidTransform& X, double most) {
  double cost = 0;
  for (const auto& other : scene.other) {
    double nearest = kFarthest_mm;
    for (const auto& own : scene.own) nearest = std::min(nearest, MeanApart(own, other, X));
    cost += nearest;
    if (cost > most) break;
  }
  return cost;
}

/// Draws triples whose speeds and distances agree, and keeps the best of their transforms.
std::optional<std::pair<double, RigidTransform>> BestOfTriples(const Scene& scene) {
  std::mt19937 random(1);
  const auto draw = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  std::optional<std::pair<double, RigidTransform>> best;
  int tried = 0;
  for (int i = 0; i < kDraws && tried < kTriples; ++i) {
    Triple triple;
    for (auto& [own, other] : triple) {
      other = draw(scene.other.size());
      own = scene.likely[other][draw(scene.likely[other].size())];
    }
    if (!IsAlikeApart(scene, triple)) continue;
    ++tried;
    const auto X = FitRigid(PlacesOf(scene, triple));
    if (!X) continue;
    const double cost = CostOf(scene, *X, best ? best->first : 1e300);
    if (!best || cost < best->first) best = {cost, *X};
  }
  return best;
}

/// Pairs tracks that are near each other, the nearest first, each once.
std::vector<std::pair<std::size_t, std::size_t>> Assigned(const Scene& scene,
                                                          const RigidTransform& X) {
  struct Candidate {
    double apart;
    std::size_t own, other;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < scene.own.size(); ++i)
    for (std::size_t k = 0; k < scene.other.size(); ++k) {
      const double apart = MeanApart(scene.own[i], scene.other[k], X);
      if (apart < kFarthest_mm) candidates.push_back({apart, i, k});
    }
  std::ranges::stable_sort(candidates, {}, &Candidate::apart);
  std::vector<bool> own_taken(scene.own.size()), other_taken(scene.other.size());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const Candidate& one : candidates) {
    if (own_taken[one.own] || other_taken[one.other]) continue;
    own_taken[one.own] = other_taken[one.other] = true;
    pairs.emplace_back(one.own, one.other);
  }
  return pairs;
}

struct MotionMatch {
  double offset_s = 0, cost = 0;
  RigidTransform X;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
};

/// Alternates between pairing and fitting, until the pairs stay.
std::optional<MotionMatch> MatchIn(const Scene& scene) {
  const auto start = BestOfTriples(scene);
  if (!start) return {};
  MotionMatch match;
  match.X = start->second;
  for (int i = 0; i < 10; ++i) {
    const auto pairs = Assigned(scene, match.X);
    if (pairs == match.pairs) break;
    match.pairs = pairs;
    const auto fit = FitRobustly(PlacesOf(scene, pairs));
    if (!fit) return {};
    match.X = fit->X;
  }
  match.cost = CostOf(scene, match.X, 1e300) / static_cast<double>(scene.other.size());
  return match;
}

std::vector<NamedPair> NamesOf(const ResultMotion& own, const RecordedMotion& other,
                               const MotionMatch& match) {
  std::vector<NamedPair> names;
  for (const auto& [i, k] : match.pairs)
    names.push_back({own.motion.points[i].name, {other.points[k].name}});
  return names;
}

/// At an offset that is known to a part of a frame, near points are told apart better.
void PairAgain(const ResultMotion& own, const RecordedMotion& other, double step_s,
               Alignment& alignment) {
  RecordedMotion shifted = other;
  for (double& time_s : shifted.time_s) time_s += alignment.offset_s;
  const SampledTracks tracks(own.motion, step_s);
  Scene scene;
  scene.own = tracks.places;
  for (const PointTrack& track : shifted.points)
    scene.other.push_back(Resampled(shifted, track, tracks.grid));
  MotionMatch match;
  match.pairs = Assigned(scene, alignment.X);
  alignment.pairs = PairsOf(own, other, NamesOf(own, other, match));
}

}  // namespace

std::optional<Alignment> AlignByMotion(const ResultMotion& own, const RecordedMotion& other) {
  if (other.points.size() < 3) return {};
  const double step_s = CoarseStep(own.motion, other);
  const SampledTracks own_tracks(own.motion, step_s), other_tracks(other, step_s);
  const std::vector<Signal> own_quantiles = Quantiles(own_tracks.speeds);
  const std::vector<Signal> other_quantiles = Quantiles(other_tracks.speeds);
  std::vector<SignalPair> signals;
  for (std::size_t i = 0; i < own_quantiles.size(); ++i)
    signals.push_back({own_quantiles[i], other_quantiles[i]});
  std::optional<MotionMatch> best;
  for (const OffsetCandidate& candidate :
       FindOffsets(signals, LeastOverlap(own.motion, other, step_s), kMostOffsetsByMotion)) {
    const auto match = MatchIn(
        SceneAt(own_tracks, other_tracks, static_cast<std::ptrdiff_t>(std::lround(candidate.lag))));
    if (!match || match->pairs.size() < 3 || (best && match->cost >= best->cost)) continue;
    best = match;
    best->offset_s = own.motion.time_s.front() - other.time_s.front() + step_s * candidate.lag;
  }
  if (!best) return {};
  Alignment alignment;
  alignment.by = PairedBy::kMotion;
  alignment.offset_s = best->offset_s;
  alignment.X = best->X;
  alignment.pairs = PairsOf(own, other, NamesOf(own, other, *best));
  alignment = Refined(own, other, std::move(alignment), 2 * step_s);
  PairAgain(own, other, step_s, alignment);
  if (alignment.pairs.size() < 3) return {};
  return Refined(own, other, std::move(alignment), step_s);
}

}  // namespace mocap

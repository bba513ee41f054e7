#include "tools/import/motion_offsets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/quantile.h"
#include "tools/import/agreement_curve.h"

namespace mocap {
namespace {

/// Silhouettes differ by less, as a share of the picture's height: 40 mm at the far end of a room
/// that the picture shows for 4 m.
constexpr double kTolerance = 0.01;
/// Recordings have at least this in common [s].
constexpr double kLeastCommon_s = 1;
/// Offsets within this are one: half a step of a walker.
constexpr double kSameOffset_s = 0.25;
/// The fine search reaches so many steps of the coarse one.
constexpr double kFineReach = 3;
/// Each camera is placed again so often, when all others are.
constexpr int kSweeps = 3;

struct ComparedPair {
  int first, second;
  TangentPair tangents;
  AgreementCurve curve;
  double tolerance_px;
};

double StepOf(std::span<const CameraHulls> cameras) {
  double shortest_s = std::numeric_limits<double>::infinity();
  for (const CameraHulls& camera : cameras) {
    std::vector<double> intervals;
    for (std::size_t i = 1; i < camera.frames.size(); ++i)
      intervals.push_back(camera.frames[i].time_s - camera.frames[i - 1].time_s);
    if (!intervals.empty()) shortest_s = std::min(shortest_s, MedianOf(intervals));
  }
  // Faster cameras show nothing that half of this would miss.
  return std::clamp(shortest_s, 0.01, 0.1) / 2;
}

/// Places of all cameras on one clock; empty: not placed yet.
using Placed = std::vector<std::optional<double>>;

class Placing {
 public:
  Placing(std::span<const CameraHulls> cameras, double step_s, const std::function<void()>& check)
      : cameras_(cameras), step_s_(step_s) {
    for (int i = 0; i < std::ssize(cameras); ++i) {
      for (int j = i + 1; j < std::ssize(cameras); ++j) {
        check();
        const double tolerance_px = kTolerance * (cameras[i].height_px + cameras[j].height_px) / 2;
        ComparedPair pair{i, j, TangentsOf(cameras[i], cameras[j]), {}, tolerance_px};
        pair.curve = CurveOf(pair.tangents, step_s, kLeastCommon_s, tolerance_px);
        pairs_.push_back(std::move(pair));
      }
    }
  }

  const std::vector<ComparedPair>& pairs() const { return pairs_; }

  /// Agreement of a camera at an offset with all others that are placed.
  double GainOf(int camera, double offset_s, const Placed& placed) const {
    double gain = 0;
    for (const ComparedPair& pair : pairs_) {
      if (pair.first == camera && placed[pair.second])
        gain += pair.curve.At(*placed[pair.second] - offset_s);
      if (pair.second == camera && placed[pair.first])
        gain += pair.curve.At(offset_s - *placed[pair.first]);
    }
    return gain;
  }

  struct Place {
    double offset_s = 0, gain = 0;
    double next = 0;  ///< Gain of the best other offset.
  };

  /// Finds the offset of a camera with the most agreement.
  Place BestPlace(int camera, const Placed& placed) const {
    double begin_s = std::numeric_limits<double>::infinity(), end_s = -begin_s;
    for (const ComparedPair& pair : pairs_) {
      const double length_s = step_s_ * static_cast<double>(pair.curve.gains.size());
      const double from_s = pair.curve.begin_s, to_s = from_s + length_s;
      if (pair.second == camera && placed[pair.first]) {
        begin_s = std::min(begin_s, *placed[pair.first] + from_s);
        end_s = std::max(end_s, *placed[pair.first] + to_s);
      }
      if (pair.first == camera && placed[pair.second]) {
        begin_s = std::min(begin_s, *placed[pair.second] - to_s);
        end_s = std::max(end_s, *placed[pair.second] - from_s);
      }
    }
    std::vector<double> gains;
    for (double offset_s = begin_s; offset_s < end_s; offset_s += step_s_)
      gains.push_back(GainOf(camera, offset_s, placed));
    return BestOf(gains, begin_s);
  }

 private:
  Place BestOf(const std::vector<double>& gains, double begin_s) const {
    Place best;
    if (gains.empty()) return best;
    const auto peak = std::ranges::max_element(gains) - gains.begin();
    best = {begin_s + static_cast<double>(peak) * step_s_, gains[peak], 0};
    const auto near = static_cast<std::ptrdiff_t>(kSameOffset_s / step_s_);
    for (std::ptrdiff_t i = 0; i < std::ssize(gains); ++i)
      if (std::abs(i - peak) > near) best.next = std::max(best.next, gains[i]);
    return best;
  }

  std::span<const CameraHulls> cameras_;
  double step_s_;
  std::vector<ComparedPair> pairs_;
};

/// Places the pair that agrees best, if no camera is known.
void PlaceFirst(const Placing& placing, Placed& placed) {
  if (std::ranges::any_of(placed, [](const auto& place) { return place.has_value(); })) return;
  const ComparedPair* best = nullptr;
  float most = 0;
  for (const ComparedPair& pair : placing.pairs()) {
    if (pair.curve.gains.empty()) continue;
    const float gain = *std::ranges::max_element(pair.curve.gains);
    if (gain > most) most = gain, best = &pair;
  }
  if (best != nullptr) placed[best->first] = 0;
}

/// Places all others, those with the most agreement first.
void PlaceOthers(const Placing& placing, const std::function<void()>& check, Placed& placed) {
  for (;;) {
    check();
    int best = -1;
    Placing::Place place;
    for (int i = 0; i < std::ssize(placed); ++i) {
      if (placed[i]) continue;
      const Placing::Place own = placing.BestPlace(i, placed);
      if (own.gain > place.gain) best = i, place = own;
    }
    if (best < 0) return;
    placed[best] = place.offset_s;
  }
}

/// Refines each pair at its present offset.
std::vector<PairOffset> RefineAll(const Placing& placing, double step_s, const Placed& placed,
                                  const std::function<void()>& check) {
  std::vector<PairOffset> pairs;
  for (const ComparedPair& pair : placing.pairs()) {
    check();
    if (!placed[pair.first] || !placed[pair.second]) continue;
    const double ahead_s = *placed[pair.second] - *placed[pair.first];
    const auto fine =
        RefineOffset(pair.tangents, ahead_s, step_s, kFineReach * step_s, pair.tolerance_px);
    if (!fine) continue;
    pairs.push_back({pair.first, pair.second, fine->ahead_s, 0, {}, fine->sigma_s, 1});
  }
  return pairs;
}

/// Known clocks without rates: offsets are for the middle of what is compared.
Placed PlacesOf(std::span<const CameraHulls> cameras, const std::vector<ClockFit>& known) {
  Placed placed(cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (!known[i].is_known) continue;
    placed[i] = known[i].offset_s;
    if (!cameras[i].frames.empty())
      *placed[i] += known[i].rate_ppm * 1e-6 * cameras[i].frames.front().time_s;
  }
  return placed;
}

}  // namespace

std::vector<ClockFit> ClocksByMotion(std::span<const CameraHulls> cameras,
                                     const std::vector<ClockFit>& known,
                                     const std::function<void()>& check) {
  const double step_s = StepOf(cameras);
  const Placing placing(cameras, step_s, check);
  Placed placed = PlacesOf(cameras, known);
  PlaceFirst(placing, placed);
  PlaceOthers(placing, check, placed);
  std::vector<double> clearness(cameras.size());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int i = 0; i < std::ssize(cameras); ++i) {
      if (!placed[i] || known[i].is_known) continue;
      Placed others = placed;
      others[i].reset();
      const Placing::Place place = placing.BestPlace(i, others);
      if (!(place.gain > 0)) continue;
      placed[i] = place.offset_s;
      clearness[i] = place.gain / std::max(place.next, place.gain / 100);
    }
  }
  std::vector<ClockFit> clocks;
  // The second time about what the first one found.
  for (int round = 0; round < 2; ++round) {
    clocks = FitClocks(known, RefineAll(placing, step_s, placed, check));
    for (std::size_t i = 0; i < clocks.size(); ++i)
      if (clocks[i].is_known) placed[i] = clocks[i].offset_s;
  }
  for (std::size_t i = 0; i < clocks.size(); ++i) clocks[i].clearness = clearness[i];
  return clocks;
}

}  // namespace mocap

#include "tools/import/agreement_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/quantile.h"

namespace mocap {
namespace {

/// Fewer moments in common prove nothing.
constexpr int kFewestMoments = 20;
/// Moments between two frames: all phases of both cameras count alike, or offsets of half a frame,
/// where interpolation averages two frames, would seem the best.
constexpr int kMomentsOfStep = 4;
/// Tukey's biweight has 95 % of the efficiency of least squares (Holland and Welsch 1977).
constexpr double kTukey = 4.685;
/// Silhouettes are not more exact than this [px].
constexpr double kLeastScatter_px = 0.3;
/// Neighbouring moments err alike, for about this long: limbs hidden, shadows.
constexpr double kAlike_s = 0.2;
constexpr int kFineRounds = 3;
/// Offsets that are tried, on each side of the present one.
constexpr int kFineSteps = 20;

/// Tukey's biweight, from 0 to 1.
inline float Biweight(float error) {
  const float rest = 1 - error * error;
  return rest > 0 ? rest * rest : 0.0f;  // Also for NaN.
}

/// A track's side in columns, for fast loops.
struct Column {
  std::vector<float> angle, pixel;
};

Column ColumnOf(const SampledTrack& track, int side) {
  Column column;
  for (const TangentTrack::Touch& touch : track.touches) {
    column.angle.push_back(touch.angle_rad[side]);
    column.pixel.push_back(touch.pixel_rad[side]);
  }
  return column;
}

struct Overlap {
  double gain = 0;
  int moments = 0;
};

/// Compares moment i of the second with moment i + shift of the first.
void AddOverlap(const Column& first, const Column& second, int shift, float tolerance_px,
                Overlap& overlap) {
  const int begin = std::max(0, -shift);
  const int end =
      std::min(static_cast<int>(second.angle.size()), static_cast<int>(first.angle.size()) - shift);
  for (int i = begin; i < end; ++i) {
    const float apart = first.angle[i + shift] - second.angle[i];
    if (std::isnan(apart)) continue;
    const float pixel = first.pixel[i + shift] + second.pixel[i];
    overlap.gain += Biweight(apart / (pixel * 0.70710678f * tolerance_px));
    ++overlap.moments;
  }
}

/// Differences of one side at an offset, in pixels.
using Differences = std::array<std::vector<float>, 2>;

Differences DifferencesAt(const TangentPair& pair, double ahead_s, double moment_s) {
  Differences differences;
  const auto& first = pair.first.times_s;
  if (first.size() < 2 || pair.second.times_s.size() < 2) return differences;
  std::size_t at_first = 0, at_second = 0;
  const double begin_s = std::max(first.front(), pair.second.times_s.front() + ahead_s);
  const double end_s = std::min(first.back(), pair.second.times_s.back() + ahead_s);
  // Moments lie where the first one's frames are, whatever the offset.
  const double skipped = std::ceil((begin_s - first.front()) / moment_s);
  for (double k = std::max(skipped, 0.0); first.front() + k * moment_s < end_s; ++k) {
    const double time_s = first.front() + k * moment_s;
    const TangentTrack::Touch a = TouchAt(pair.first, time_s, at_first);
    const TangentTrack::Touch b = TouchAt(pair.second, time_s - ahead_s, at_second);
    for (int side = 0; side < 2; ++side) {
      const float pixel = std::hypot(a.pixel_rad[side], b.pixel_rad[side]);
      differences[side].push_back((a.angle_rad[side] - b.angle_rad[side]) / pixel);
    }
  }
  return differences;
}

/// Constant error and scatter of one side [px].
struct SideError {
  double bias = 0, scatter = 0;
};

std::optional<SideError> ErrorOf(const std::vector<float>& differences, double tolerance_px) {
  std::vector<double> values;
  for (const float difference : differences)
    if (std::abs(difference) < tolerance_px) values.push_back(difference);
  if (values.size() < static_cast<std::size_t>(kFewestMoments * kMomentsOfStep))
    return std::nullopt;
  SideError error{MedianOf(values), 0};
  for (double& value : values) value = std::abs(value - error.bias);
  error.scatter = std::max(kDeviationPerMedian * MedianOf(values), kLeastScatter_px);
  return error;
}

/// Logarithm of the likelihood of an offset, up to a constant.
double LikelihoodAt(const TangentPair& pair, double ahead_s, double moment_s,
                    const std::array<std::optional<SideError>, 2>& errors) {
  const Differences differences = DifferencesAt(pair, ahead_s, moment_s);
  double sum = 0;
  for (int side = 0; side < 2; ++side) {
    if (!errors[side]) continue;
    const auto bias = static_cast<float>(errors[side]->bias);
    const auto scale = static_cast<float>(1 / (kTukey * errors[side]->scatter));
    for (const float difference : differences[side]) sum += Biweight((difference - bias) * scale);
  }
  // The biweight's curvature at 0 is that of a normal distribution.
  return sum * kTukey * kTukey / 4 * moment_s / kAlike_s;
}

/// Finds the highest of likelihoods at equal steps, by a parabola through it and its neighbours.
std::optional<FineOffset> PeakOf(const std::vector<double>& likelihoods, double begin_s,
                                 double step_s) {
  const auto peak = std::ranges::max_element(likelihoods) - likelihoods.begin();
  if (peak == 0 || peak + 1 == std::ssize(likelihoods)) return std::nullopt;
  const double before = likelihoods[peak - 1], here = likelihoods[peak];
  const double after = likelihoods[peak + 1], bend = 2 * here - before - after;
  if (!(bend > 0)) return std::nullopt;
  const double beyond = (after - before) / (2 * bend);
  return FineOffset{begin_s + (static_cast<double>(peak) + beyond) * step_s,
                    step_s / std::sqrt(bend)};
}

}  // namespace

double AgreementCurve::At(double ahead_s) const {
  const auto i = std::llround((ahead_s - begin_s) / step_s);
  return i < 0 || i >= std::ssize(gains) ? 0 : gains[static_cast<std::size_t>(i)];
}

AgreementCurve CurveOf(const TangentPair& pair, double step_s, double least_s,
                       double tolerance_px) {
  const SampledTrack first = Sample(pair.first, step_s), second = Sample(pair.second, step_s);
  const int least = std::max(kFewestMoments, static_cast<int>(least_s / step_s));
  const int lowest = least - static_cast<int>(second.touches.size());
  const int highest = static_cast<int>(first.touches.size()) - least;
  AgreementCurve curve{first.begin_s - second.begin_s + lowest * step_s, step_s, {}};
  if (highest < lowest) return curve;
  std::vector<Overlap> overlaps(highest - lowest + 1);
  Overlap all;
  for (int side = 0; side < 2; ++side) {
    const Column a = ColumnOf(first, side), b = ColumnOf(second, side);
    for (int shift = lowest; shift <= highest; ++shift)
      AddOverlap(a, b, shift, static_cast<float>(tolerance_px), overlaps[shift - lowest]);
  }
  for (const Overlap& overlap : overlaps) all.gain += overlap.gain, all.moments += overlap.moments;
  const double by_chance = all.moments > 0 ? all.gain / all.moments : 0;
  for (const Overlap& overlap : overlaps)
    curve.gains.push_back(static_cast<float>(overlap.gain - by_chance * overlap.moments));
  return curve;
}

std::optional<FineOffset> RefineOffset(const TangentPair& pair, double ahead_s, double step_s,
                                       double reach_s, double tolerance_px) {
  FineOffset offset{ahead_s, 0};
  const double moment_s = step_s / kMomentsOfStep;
  double width_s = reach_s;
  for (int round = 0; round < kFineRounds; ++round) {
    const Differences differences = DifferencesAt(pair, offset.ahead_s, moment_s);
    const std::array errors = {ErrorOf(differences[0], tolerance_px),
                               ErrorOf(differences[1], tolerance_px)};
    if (!errors[0] && !errors[1]) return std::nullopt;
    std::vector<double> likelihoods;
    const double fine_s = width_s / kFineSteps, begin_s = offset.ahead_s - width_s;
    for (int i = 0; i <= 2 * kFineSteps; ++i)
      likelihoods.push_back(LikelihoodAt(pair, begin_s + i * fine_s, moment_s, errors));
    const std::optional<FineOffset> peak = PeakOf(likelihoods, begin_s, fine_s);
    if (!peak || std::abs(peak->ahead_s - ahead_s) > reach_s) return std::nullopt;
    offset = *peak;
    width_s = std::max(width_s / 2, 2 * fine_s);
  }
  return offset;
}

}  // namespace mocap

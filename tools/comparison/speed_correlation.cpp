#include "tools/comparison/speed_correlation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

namespace mocap {
namespace {

using Spectrum = std::vector<std::complex<double>>;

/// Spectra of a signal without its mean, of its square, and of where it is known.
struct Spectra {
  Spectrum known, value, square;
};

class Correlator {
 public:
  explicit Correlator(std::size_t samples) : size_(std::bit_ceil(samples)) {}

  Spectra SpectraOf(const Signal& signal) {
    double sum = 0;
    std::size_t count = 0;
    for (const double value : signal) {
      if (!std::isfinite(value)) continue;
      sum += value;
      ++count;
    }
    const double mean = count > 0 ? sum / static_cast<double>(count) : 0;
    std::vector<double> known(size_), value(size_), square(size_);
    for (std::size_t i = 0; i < signal.size(); ++i) {
      if (!std::isfinite(signal[i])) continue;
      known[i] = 1;
      value[i] = signal[i] - mean;
      square[i] = value[i] * value[i];
    }
    return {Forward(known), Forward(value), Forward(square)};
  }

  /// Sums of a[i + lag] b[i] over i; a lag below 0 is at the end.
  std::vector<double> Sums(const Spectrum& a, const Spectrum& b) {
    Spectrum product(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) product[i] = a[i] * std::conj(b[i]);
    std::vector<double> sums;
    fft_.inv(sums, product);
    return sums;
  }

  std::size_t size() const { return size_; }

 private:
  Spectrum Forward(const std::vector<double>& values) {
    Spectrum spectrum;
    fft_.fwd(spectrum, values);
    return spectrum;
  }

  std::size_t size_;
  Eigen::FFT<double> fft_;
};

/// Correlations summed over pairs at each lag, with their number and overlap.
struct LagSums {
  std::vector<double> correlation, pairs, overlap;
};

void AddPair(const SignalPair& pair, std::size_t least_overlap, Correlator& correlator,
             LagSums& sums) {
  const Spectra a = correlator.SpectraOf(pair.a), b = correlator.SpectraOf(pair.b);
  const auto n = correlator.Sums(a.known, b.known), a_sum = correlator.Sums(a.value, b.known),
             b_sum = correlator.Sums(a.known, b.value), aa = correlator.Sums(a.square, b.known),
             bb = correlator.Sums(a.known, b.square), ab = correlator.Sums(a.value, b.value);
  // Of what rounding leaves, nothing correlates.
  const double least_aa = 1e-9 * *std::ranges::max_element(aa);
  const double least_bb = 1e-9 * *std::ranges::max_element(bb);
  for (std::size_t i = 0; i < n.size(); ++i) {
    if (n[i] + 0.5 < static_cast<double>(least_overlap)) continue;
    const double var_a = aa[i] - a_sum[i] * a_sum[i] / n[i];
    const double var_b = bb[i] - b_sum[i] * b_sum[i] / n[i];
    if (var_a <= least_aa || var_b <= least_bb) continue;
    sums.correlation[i] += (ab[i] - a_sum[i] * b_sum[i] / n[i]) / std::sqrt(var_a * var_b);
    sums.overlap[i] += n[i];
    ++sums.pairs[i];
  }
}

/// Where the parabola through three neighbours is highest, relative to the middle one.
double VertexOf(double before, double here, double after) {
  const double curvature = before - 2 * here + after;
  return curvature < 0 ? std::clamp((before - after) / (2 * curvature), -0.5, 0.5) : 0;
}

}  // namespace

TimeGrid GridOf(const RecordedMotion& motion, double step_s) {
  return {motion.time_s.front(), step_s,
          static_cast<std::size_t>(motion.Seconds() / step_s + 1e-6) + 1};
}

std::vector<Vector3> Resampled(const RecordedMotion& motion, const PointTrack& track,
                               const TimeGrid& grid) {
  std::vector<Vector3> sums(grid.count, Vector3::Zero());
  std::vector<int> counts(grid.count);
  for (std::size_t f = 0; f < motion.time_s.size(); ++f) {
    const double at = std::round((motion.time_s[f] - grid.first_s) / grid.step_s);
    if (at < 0 || at >= static_cast<double>(grid.count) || !track.p_mm[f].allFinite()) continue;
    const auto i = static_cast<std::size_t>(at);
    sums[i] += track.p_mm[f];
    ++counts[i];
  }
  // Few frames around a time are not in its middle: there, and where none is, between frames.
  const FrameFinder frames(motion);
  for (std::size_t i = 0; i < grid.count; ++i) {
    if (counts[i] >= 3) {
      sums[i] /= counts[i];
      continue;
    }
    const auto place = frames.Find(grid.At(i));
    sums[i] = place ? PointAt(track.p_mm, *place) : Unseen();
  }
  return sums;
}

Signal SpeedOf(const std::vector<Vector3>& p_mm, double step_s) {
  Signal speed(p_mm.size(), kUnmeasured);
  for (std::size_t i = 1; i + 1 < p_mm.size(); ++i)
    speed[i] = (p_mm[i + 1] - p_mm[i - 1]).norm() / (2 * step_s);
  return speed;
}

Signal Resampled(const RecordedMotion& motion, const AngleCurve& track, const TimeGrid& grid) {
  const FrameFinder frames(motion);
  Signal signal(grid.count, kUnmeasured);
  for (std::size_t i = 0; i < grid.count; ++i)
    if (const auto place = frames.Find(grid.At(i))) signal[i] = AngleAt(track.deg, *place);
  return signal;
}

std::vector<Signal> Quantiles(const std::vector<Signal>& signals) {
  constexpr std::size_t kQuarters = 4;
  std::size_t count = 0;
  for (const Signal& signal : signals) count = std::max(count, signal.size());
  std::vector<Signal> quantiles(kQuarters + 1, Signal(count, kUnmeasured));
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.clear();
    for (const Signal& signal : signals)
      if (i < signal.size() && std::isfinite(signal[i])) values.push_back(signal[i]);
    if (values.empty()) continue;
    std::ranges::sort(values);
    for (std::size_t q = 0; q <= kQuarters; ++q)
      quantiles[q][i] = values[q * (values.size() - 1) / kQuarters];
  }
  return quantiles;
}

std::vector<OffsetCandidate> FindOffsets(const std::vector<SignalPair>& pairs,
                                         std::size_t least_overlap, std::size_t most) {
  if (pairs.empty()) return {};
  std::size_t longest = 0;
  for (const SignalPair& pair : pairs) longest = std::max(longest, pair.a.size() + pair.b.size());
  Correlator correlator(longest + 1);
  const std::size_t size = correlator.size();
  LagSums sums{std::vector<double>(size), std::vector<double>(size), std::vector<double>(size)};
  for (const SignalPair& pair : pairs) AddPair(pair, least_overlap, correlator, sums);
  const auto correlation = [&](std::size_t i) {
    return sums.pairs[i] > 0 ? sums.correlation[i] / sums.pairs[i] : -1.0;
  };
  std::vector<OffsetCandidate> found;
  for (std::size_t i = 0; i < size; ++i) {
    const double here = correlation(i);
    // What correlates less tells nothing of the time.
    constexpr double kLeastCorrelation = 0.1;
    if (here < kLeastCorrelation || here < correlation((i + 1) % size) ||
        here < correlation((i + size - 1) % size))
      continue;
    const double overlap = sums.overlap[i] / sums.pairs[i];
    const auto lag = static_cast<double>(i);
    found.push_back(
        {(i < size / 2 ? lag : lag - static_cast<double>(size)) +
             VertexOf(correlation((i + size - 1) % size), here, correlation((i + 1) % size)),
         here, std::atanh(std::min(here, 0.9999)) * std::sqrt(overlap)});
  }
  std::ranges::sort(found, std::greater(), &OffsetCandidate::strength);
  if (found.size() > most) found.resize(most);
  return found;
}

}  // namespace mocap

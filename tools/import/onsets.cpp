#include "tools/import/onsets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>

#include "core/quantile.h"

namespace mocap {
namespace {

constexpr int kSamplesPerOnset = kSoundRate_hz / kOnsetRate_hz;
/// Digital silence is no sound [square of the smallest step, for each sample].
constexpr double kSilence = 1;
/// Shifts closer than this are one.
constexpr int kOneShift = kOnsetRate_hz / 10;

/// Energy of the differences of samples: rumble and hum have little.
std::vector<double> EnergiesOf(const SoundTrack& track) {
  const auto& samples = track.samples;
  std::vector<double> energies(samples.size() / kSamplesPerOnset);
  for (std::size_t k = 0; k < energies.size(); ++k) {
    double energy = 0;
    for (std::size_t i = k * kSamplesPerOnset; i < (k + 1) * kSamplesPerOnset; ++i) {
      const double step = i == 0 ? 0 : samples[i] - samples[i - 1];
      energy += step * step;
    }
    energies[k] = energy;
  }
  return energies;
}

cv::Mat SpectrumOf(const std::vector<float>& values, int size) {
  cv::Mat padded = cv::Mat::zeros(1, size, CV_32F);
  std::ranges::copy(values, padded.ptr<float>());
  cv::Mat spectrum;
  cv::dft(padded, spectrum);
  return spectrum;
}

}  // namespace

std::vector<float> OnsetsOf(const SoundTrack& track) {
  const std::vector<double> energies = EnergiesOf(track);
  if (energies.size() < 2) return {};
  std::vector<double> sorted = energies;
  const double noise = MedianOf(sorted) + kSilence * kSamplesPerOnset;
  std::vector<float> onsets(energies.size());
  for (std::size_t k = 1; k < energies.size(); ++k) {
    // A sound that begins within a window is louder still in the next one.
    const double before = energies[k >= 2 ? k - 2 : 0];
    const double louder = std::log((energies[k] + noise) / (before + noise));
    onsets[k] = static_cast<float>(std::max(louder, 0.0));
  }
  return onsets;
}

std::vector<OnsetShift> BestShifts(const std::vector<float>& first,
                                   const std::vector<float>& second, std::size_t most) {
  if (first.empty() || second.empty()) return {};
  const int size = cv::getOptimalDFTSize(static_cast<int>(first.size() + second.size()));
  cv::Mat product, correlation;
  cv::mulSpectrums(SpectrumOf(first, size), SpectrumOf(second, size), product, 0, true);
  cv::dft(product, correlation, cv::DFT_INVERSE | cv::DFT_SCALE);
  const float* values = correlation.ptr<float>();
  std::vector<OnsetShift> shifts;
  const int before = static_cast<int>(second.size()) - 1, after = static_cast<int>(first.size());
  const auto at = [&](int shift) { return values[shift < 0 ? shift + size : shift]; };
  for (int shift = -before; shift < after; ++shift) {
    const bool is_peak = (shift == -before || at(shift) >= at(shift - 1)) &&
                         (shift + 1 == after || at(shift) > at(shift + 1));
    if (is_peak && at(shift) > 0) shifts.push_back({shift, at(shift)});
  }
  std::ranges::stable_sort(shifts, std::greater(), &OnsetShift::agreement);
  std::vector<OnsetShift> best;
  for (const OnsetShift& shift : shifts) {
    if (best.size() == most) break;
    const bool is_new = std::ranges::none_of(best, [&](const OnsetShift& other) {
      return std::abs(other.shift - shift.shift) < kOneShift;
    });
    if (is_new) best.push_back(shift);
  }
  return best;
}

std::vector<int> ClearestOnsets(const std::vector<float>& onsets, int begin, int end,
                                std::size_t most) {
  std::vector<int> places;
  begin = std::max(begin, 0), end = std::min(end, static_cast<int>(onsets.size()));
  for (int k = begin; k < end; ++k)
    if (onsets[k] > 0) places.push_back(k);
  std::ranges::stable_sort(places, [&](int a, int b) { return onsets[a] > onsets[b]; });
  std::vector<int> clearest;
  for (const int place : places) {
    if (clearest.size() == most) break;
    const bool is_apart = std::ranges::none_of(
        clearest, [&](int other) { return std::abs(other - place) < kOnsetRate_hz; });
    if (is_apart) clearest.push_back(place);
  }
  std::ranges::sort(clearest);
  return clearest;
}

}  // namespace mocap

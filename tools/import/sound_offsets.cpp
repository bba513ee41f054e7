#include "tools/import/sound_offsets.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/quantile.h"
#include "tools/import/onsets.h"

namespace mocap {
namespace {

/// Of each stretch: before and after its onset. A clap and its echoes in a room last that long.
constexpr int kBefore = kSoundRate_hz / 10, kStretch = kSoundRate_hz / 2;
/// Clocks of phones drift by tens of microseconds a second: this much in hours, and half an onset.
constexpr int kReach = kSoundRate_hz / 4;
constexpr std::size_t kCandidates = 5;
/// Parts of the recording, and stretches of each.
constexpr int kParts = 16;
constexpr std::size_t kStretchesOfPart = 4;
/// A peak counts from this many times the largest one that chance makes.
constexpr double kBeyondChance = 2;
/// Stretches agree within this [s]: sound travels so long through a studio.
constexpr double kAgreement_s = 0.01;
/// The best candidate has at least so many times the agreement of the next.
constexpr double kLeastClearness = 1.5;
/// Over less time, a drift is less than what it is measured with.
constexpr double kLeastForDrift_s = 300;
/// Half of what sound needs for a metre: where it came from is unknown.
constexpr double kSoundSigma_s = 0.0015;

/// An onset that both recordings have.
struct HeardTwice {
  double at_s = 0;     ///< On the first one's clock.
  double ahead_s = 0;  ///< How far the first one is ahead.
  double height = 0;   ///< Of the peak, from 0 to 1.
};

struct Agreement {
  std::vector<HeardTwice> heard;
  double slope = 0, middle_s = 0, ahead_s = 0;  ///< Of the line through them.
  double height = 0;                            ///< Sum over those on the line.
};

/// Largest correlation of `size` random phases, over `lags` lags: Gaussian, with variance 1 / size.
double ChanceHeight(double size, double lags) { return std::sqrt(2 * std::log(lags) / size); }

cv::Mat PaddedStretch(const SoundTrack& track, std::ptrdiff_t begin, int length, int size) {
  cv::Mat padded = cv::Mat::zeros(1, size, CV_32F);
  auto* out = padded.ptr<float>();
  const auto end = static_cast<std::ptrdiff_t>(track.samples.size());
  for (int i = 0; i < length; ++i) {
    const std::ptrdiff_t at = begin + i;
    if (at >= 0 && at < end) out[i] = track.samples[static_cast<std::size_t>(at)];
  }
  return padded;
}

/// Divides a spectrum, packed as by OpenCV, by its magnitudes.
void Whiten(cv::Mat& spectrum) {
  auto* values = spectrum.ptr<float>();
  const int size = spectrum.cols;
  values[0] = 0;  // A microphone's constant voltage is no sound.
  for (int i = 1; i + 1 < size; i += 2) {
    const float magnitude = std::hypot(values[i], values[i + 1]);
    if (magnitude > 0) values[i] /= magnitude, values[i + 1] /= magnitude;
  }
  if (size % 2 == 0) values[size - 1] = 0;
}

/// Compares the stretch about an onset of the first one with the second one, at a shift [samples].
std::optional<HeardTwice> Compare(const SoundTrack& first, const SoundTrack& second,
                                  std::ptrdiff_t onset, std::ptrdiff_t shift) {
  constexpr int kWide = kStretch + 2 * kReach;
  const int size = cv::getOptimalDFTSize(kWide + kStretch);
  const std::ptrdiff_t begin = onset - kBefore, other = begin - shift - kReach;
  cv::Mat a, b, product, correlation;
  cv::dft(PaddedStretch(first, begin, kStretch, size), a);
  cv::dft(PaddedStretch(second, other, kWide, size), b);
  cv::mulSpectrums(b, a, product, 0, true);
  Whiten(product);
  cv::dft(product, correlation, cv::DFT_INVERSE | cv::DFT_SCALE);
  const float* heights = correlation.ptr<float>();
  const int peak = static_cast<int>(std::max_element(heights, heights + 2 * kReach) - heights);
  if (heights[peak] < kBeyondChance * ChanceHeight(kStretch, 2 * kReach)) return std::nullopt;
  const double shift_s = static_cast<double>(shift + kReach - peak) / kSoundRate_hz;
  return HeardTwice{
      static_cast<double>(first.first_ns) / 1e9 + static_cast<double>(onset) / kSoundRate_hz,
      static_cast<double>(first.first_ns - second.first_ns) / 1e9 + shift_s, heights[peak]};
}

/// Finds the line on which most of the heard lie: a drift is constant enough.
void FitLine(Agreement& agreement) {
  auto& heard = agreement.heard;
  if (heard.empty()) return;
  const double span_s = heard.back().at_s - heard.front().at_s;
  std::vector<double> slopes, values;
  for (std::size_t i = 0; i < heard.size() && span_s >= kLeastForDrift_s; ++i) {
    for (std::size_t j = i + 1; j < heard.size(); ++j) {
      if (heard[j].at_s - heard[i].at_s > span_s / 3)
        slopes.push_back((heard[j].ahead_s - heard[i].ahead_s) / (heard[j].at_s - heard[i].at_s));
    }
  }
  // Theil 1950, Sen 1968: medians, so that the others may be anything.
  if (!slopes.empty()) agreement.slope = MedianOf(slopes);
  agreement.middle_s = heard.front().at_s + span_s / 2;
  const auto level = [&](const HeardTwice& one) {
    return one.ahead_s - agreement.slope * (one.at_s - agreement.middle_s);
  };
  // The level with the most agreement; a median of few would lie between two.
  for (const HeardTwice& one : heard) {
    double height = 0;
    for (const HeardTwice& other : heard)
      if (std::abs(level(other) - level(one)) < kAgreement_s) height += other.height;
    if (height > agreement.height) agreement.height = height, agreement.ahead_s = level(one);
  }
  std::erase_if(heard, [&](const HeardTwice& one) {
    return std::abs(level(one) - agreement.ahead_s) >= kAgreement_s;
  });
  for (const HeardTwice& one : heard) values.push_back(level(one));
  agreement.ahead_s = MedianOf(values);
}

/// @param shift  of onsets.
Agreement AgreementAt(const SoundTrack& first, const SoundTrack& second,
                      const std::vector<float>& onsets, int count_of_second, int shift) {
  constexpr int kSamples = kSoundRate_hz / kOnsetRate_hz;
  const int begin = std::max(0, shift);
  const int end = std::min(static_cast<int>(onsets.size()), count_of_second + shift);
  Agreement agreement;
  for (int part = 0; part < kParts && begin < end; ++part) {
    const auto edge = [&](int i) {
      return begin + static_cast<int>(static_cast<std::int64_t>(end - begin) * i / kParts);
    };
    for (const int onset : ClearestOnsets(onsets, edge(part), edge(part + 1), kStretchesOfPart)) {
      const auto heard = Compare(first, second, static_cast<std::ptrdiff_t>(onset) * kSamples,
                                 static_cast<std::ptrdiff_t>(shift) * kSamples);
      if (heard) agreement.heard.push_back(*heard);
    }
  }
  FitLine(agreement);
  return agreement;
}

PairOffset OffsetOf(const Agreement& best, double clearness) {
  double squares = 0;
  for (const HeardTwice& heard : best.heard) {
    const double error_s = heard.ahead_s - best.slope * (heard.at_s - best.middle_s) - best.ahead_s;
    squares += error_s * error_s;
  }
  PairOffset offset;
  offset.ahead_s = best.ahead_s;
  offset.at_s = best.middle_s;
  const double span_s = best.heard.back().at_s - best.heard.front().at_s;
  if (span_s >= kLeastForDrift_s) offset.rate_ppm = best.slope * 1e6;
  offset.sigma_s =
      std::sqrt(squares / static_cast<double>(best.heard.size()) + kSoundSigma_s * kSoundSigma_s);
  offset.clearness = clearness;
  return offset;
}

std::optional<PairOffset> OffsetBetween(const SoundTrack& first, const std::vector<float>& onsets_1,
                                        const SoundTrack& second,
                                        const std::vector<float>& onsets_2) {
  std::vector<Agreement> found;
  for (const OnsetShift& shift : BestShifts(onsets_1, onsets_2, kCandidates))
    found.push_back(
        AgreementAt(first, second, onsets_1, static_cast<int>(onsets_2.size()), shift.shift));
  std::ranges::stable_sort(found, std::greater(), &Agreement::height);
  if (found.empty() || found[0].heard.empty()) return std::nullopt;
  // Candidates within each other's reach find the same.
  double next = kBeyondChance * ChanceHeight(kStretch, 2 * kReach) / 2;
  for (const Agreement& other : found) {
    if (std::abs(other.ahead_s - found[0].ahead_s) > kAgreement_s)
      next = std::max(next, other.height);
  }
  const double clearness = found[0].height / next;
  if (clearness < kLeastClearness) return std::nullopt;
  return OffsetOf(found[0], clearness);
}

}  // namespace

std::optional<PairOffset> SoundOffset(const SoundTrack& first, const SoundTrack& second) {
  return OffsetBetween(first, OnsetsOf(first), second, OnsetsOf(second));
}

std::vector<PairOffset> SoundOffsets(std::span<const std::optional<SoundTrack>> tracks,
                                     const std::function<void()>& check) {
  std::vector<std::vector<float>> onsets;
  for (const auto& track : tracks)
    onsets.push_back(track ? OnsetsOf(*track) : std::vector<float>());
  std::vector<PairOffset> offsets;
  for (int i = 0; i < static_cast<int>(tracks.size()); ++i) {
    for (int j = i + 1; j < static_cast<int>(tracks.size()); ++j) {
      check();
      if (!tracks[i] || !tracks[j]) continue;
      auto offset = OffsetBetween(*tracks[i], onsets[i], *tracks[j], onsets[j]);
      if (!offset) continue;
      offset->first = i, offset->second = j;
      offsets.push_back(*offset);
    }
  }
  return offsets;
}

}  // namespace mocap

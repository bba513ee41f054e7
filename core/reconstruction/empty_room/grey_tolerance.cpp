#include "core/reconstruction/empty_room/grey_tolerance.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr int kNoiseStep_px = 2;
/// Of a brightness that is rarer than this, people's clothes may show most.
constexpr double kRareBrightness = 0.05;
/// The tolerance in standard deviations, and its least value [grey levels]: behind a codec, noise
/// is nearly nothing at most times and then jumps.
constexpr double kSigmas = 4.5;
constexpr double kLeastTolerance = 2, kMostTolerance = 60;
/// People may cover half of a picture's places of one brightness. So noise is read at a quarter of
/// the differences: at this size in a normal distribution [standard deviations].
constexpr double kUndisturbedShare = 0.25, kUndisturbedSize = 0.3186;

/// The undisturbed size, between whole numbers: each stands for half a unit to both of its sides.
double UndisturbedOf(std::span<const std::int64_t> counts) {
  const std::int64_t sum = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  double left = kUndisturbedShare * static_cast<double>(sum);
  std::size_t value = 0;
  while (left > static_cast<double>(counts[value])) left -= static_cast<double>(counts[value++]);
  const double share = left / static_cast<double>(counts[value]);
  return value == 0 ? share / 2 : static_cast<double>(value) - 0.5 + share;
}

}  // namespace

void NoiseMeter::Add(ImageView<const Bgr> picture) {
  const int columns = (picture.width() + kNoiseStep_px - 1) / kNoiseStep_px;
  const int rows = (picture.height() + kNoiseStep_px - 1) / kNoiseStep_px;
  const bool is_first = before_.empty();
  if (is_first) before_ = Image<Bgr>(columns, rows);
  MOCAP_CHECK(before_.width() == columns && before_.height() == rows);
  const auto count = [this](std::uint8_t before, std::uint8_t now) {
    ++counts_[before * kBins / 256][static_cast<std::size_t>(std::abs(before - now))];
  };
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Bgr now = picture(x * kNoiseStep_px, y * kNoiseStep_px);
      Bgr& before = before_(x, y);
      if (!is_first) {
        count(before.b, now.b);
        count(before.g, now.g);
        count(before.r, now.r);
      }
      before = now;
    }
  }
}

GreyTolerance NoiseMeter::Tolerance() const {
  std::array<std::int64_t, kBins> sums;
  for (int bin = 0; bin < kBins; ++bin)
    sums[bin] = std::accumulate(counts_[bin].begin(), counts_[bin].end(), std::int64_t{0});
  const auto all = static_cast<double>(std::accumulate(sums.begin(), sums.end(), std::int64_t{0}));
  std::array<std::optional<double>, kBins> sigmas;
  for (int bin = 0; bin < kBins; ++bin) {
    // Both pictures have noise.
    if (static_cast<double>(sums[bin]) >= kRareBrightness * all && sums[bin] > 0)
      sigmas[bin] = UndisturbedOf(counts_[bin]) / kUndisturbedSize / std::sqrt(2.0);
  }
  GreyTolerance tolerance;
  for (int value = 0; value < 256; ++value) {
    const int own = value * kBins / 256;
    double sigma = 0;
    for (int away = 0, found = 0; away < kBins && !found; ++away) {
      for (const int bin : {own - away, own + away}) {
        if (bin < 0 || bin >= kBins || !sigmas[bin]) continue;
        sigma = std::max(sigma, *sigmas[bin]);
        found = 1;
      }
    }
    tolerance.of[static_cast<std::size_t>(value)] = static_cast<std::uint8_t>(
        std::clamp(std::ceil(kSigmas * sigma), kLeastTolerance, kMostTolerance));
  }
  return tolerance;
}

}  // namespace mocap

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/errors.h"
#include "core/kernels/expected_pixels.h"
#include "core/reconstruction/silhouette/background_model.h"
#include "core/reconstruction/silhouette/coarse_scan.h"

namespace mocap {
namespace {

// This many frames fill the histograms well enough.
constexpr std::size_t kMostHistogramFrames = 16;

// Sums over frames, per channel.
struct ColorSums {
  explicit ColorSums(std::size_t pixels) {
    for (auto* planes : {&value, &value_sq})
      for (auto& plane : *planes) plane.resize(pixels);
  }
  // Adds a row, or subtracts it again.
  void Add(const Bgr* row, int count, const std::array<float, 3>& gain, float times,
           std::size_t begin) {
    const std::array<const std::uint8_t*, 3> channels = {&row->b, &row->g, &row->r};
    for (int c = 0; c < 3; ++c)
      kernels::AddValues(channels[c], count, gain[c], times, &value[c][begin], &value_sq[c][begin]);
  }

  std::array<std::vector<float>, 3> value, value_sq;
};

class FixedBackground final : public BackgroundModel {
 public:
  FixedBackground(std::span<const BackgroundFrame> frames, double detection_rate)
      : frames_(frames),
        conditions_(frames.size()),
        sums_(frames[0].image.pixels().size()),
        half_(frames[0].image.width(), frames[0].image.height()),
        expected_(frames[0].image.width(), frames[0].image.height()) {
    MOCAP_CHECK(frames.size() >= 2);
    // The first pass measures the flicker of the light, the second learns without it.
    for (int i = 0; i < 2; ++i) {
      SumColors();
      Expect();
      LearnHalf();
      LearnConditions();
    }
    Expect();
    LearnThresholds(detection_rate);
    frames_ = {};
    sums_ = ColorSums(0), conditions_ = {};
  }

  const ExpectedHalf& CoarsePass(const PanTiltAngles&, const Displacement& displacement) override {
    if (displacement == Displacement{}) return half_;
    if (displaced_half_.variance.empty())
      displaced_half_ = ExpectedHalf(expected_.width, expected_.height);
    displaced_half_.Displace(half_, displacement);
    displaced_half_.Finish();
    return displaced_half_;
  }

  const ExpectedPicture& Expect(const RegionOfInterest& roi,
                                const Conditions& conditions) override {
    const bool is_displaced = !(conditions.displacement == Displacement{});
    const bool is_plain = !is_displaced && conditions.shift_px == 0;
    if (is_plain && is_weighed_plainly_) return expected_;
    if (is_displaced && displaced_.mean[0].empty())
      displaced_ = ExpectedPicture(expected_.width, expected_.height);
    ExpectedPicture& picture = is_displaced ? displaced_ : expected_;
    for (int y = 0; y < expected_.height; ++y) {
      roi.ForEachMeasured(y, [&](const PixelRun& run) {
        if (is_displaced)
          picture.Displace(expected_, conditions.displacement, y, run.begin, run.end);
        picture.Weigh(conditions.shift_px, y, run.begin, run.end);
      });
    }
    is_weighed_plainly_ = is_weighed_plainly_ && is_displaced;
    return picture;
  }

 private:
  const Bgr* RowOf(std::size_t frame, int y) const { return frames_[frame].image.row(y); }
  std::size_t BeginOf(int y) const { return static_cast<std::size_t>(y) * expected_.width; }

  void Expect() {
    for (int y = 0; y < expected_.height; ++y)
      ExpectRow(sums_, BeginOf(y), frames_.size(), y, expected_);
  }

  void ExpectRow(const ColorSums& sums, std::size_t begin, std::size_t frames, int y,
                 ExpectedPicture& to) const {
    const std::size_t row = BeginOf(y);
    kernels::PixelSums of_row;
    kernels::LearnedPixels learned{{}, {}, &to.slope[row]};
    for (int c = 0; c < 3; ++c) {
      of_row.value[c] = &sums.value[c][begin], of_row.value_sq[c] = &sums.value_sq[c][begin];
      learned.mean[c] = &to.mean[c][row], learned.variance[c] = &to.variance[c][row];
    }
    kernels::ExpectPixels(of_row, to.width, static_cast<float>(frames), half_.usual_shift_px,
                          learned);
    to.Weigh(0, y, 0, to.width);
  }

  void SumColors() {
    sums_ = ColorSums(frames_[0].image.pixels().size());
    for (int y = 0; y < expected_.height; ++y)
      for (std::size_t f = 0; f < frames_.size(); ++f)
        sums_.Add(RowOf(f, y), expected_.width, conditions_[f].gain, 1, BeginOf(y));
  }

  // Computes the half-size picture and its slopes from the full-size one.
  void LearnHalf() {
    const int width = expected_.width;
    Image<Bgr> rounded(width, expected_.height);
    std::vector<float> brightness(rounded.pixels().size());
    for (std::size_t i = 0; i < brightness.size(); ++i) {
      std::array<std::uint8_t, 3> color;
      for (int c = 0; c < 3; ++c) {
        color[c] = static_cast<std::uint8_t>(std::min(std::lround(expected_.mean[c][i]), 255L));
        brightness[i] += expected_.mean[c][i] / 3;
      }
      rounded.pixels()[i] = {color[0], color[1], color[2]};
    }
    std::ranges::copy(SlopeOf(brightness, width, expected_.height), expected_.slope.begin());
    half_.LearnFrom(rounded.view());
    constexpr int kStep_px = HalfPicture::kRowStep_px;
    for (int y = 0; y * kStep_px + 1 < expected_.height; ++y) {
      for (int x = 0; x < width / 2; ++x) {
        const std::size_t i = BeginOf(y * kStep_px) + 2 * x;
        float sum = 0;
        for (const auto& variance : expected_.variance)
          sum += variance[i] + variance[i + 1] + variance[i + width] + variance[i + width + 1];
        half_.variance[static_cast<std::size_t>(y) * half_.mean.width + x] = sum / 12;
      }
    }
    half_.Finish();
  }

  void LearnConditions() {
    CoarseScan scan;
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      scan.Compare(half_, frames_[f].image.view());
      conditions_[f].gain = scan.conditions().gain;
      half_.usual_distance = std::max(half_.usual_distance, scan.distance());
      half_.usual_shift_px = std::max(half_.usual_shift_px, scan.shift_px());
    }
  }

  // Compares each frame with the background learned from the others alone.
  void LearnThresholds(double detection_rate) {
    DistortionHistograms histograms;
    ExpectedPicture by_others = expected_;
    ColorSums others(static_cast<std::size_t>(expected_.width));
    const std::size_t used = std::min(frames_.size(), kMostHistogramFrames);
    for (std::size_t k = 0; k < used; ++k) {
      const std::size_t f = k * frames_.size() / used;
      for (int y = 0; y < expected_.height; ++y) {
        for (int c = 0; c < 3; ++c) {
          std::copy_n(&sums_.value[c][BeginOf(y)], expected_.width, others.value[c].data());
          std::copy_n(&sums_.value_sq[c][BeginOf(y)], expected_.width, others.value_sq[c].data());
        }
        others.Add(RowOf(f, y), expected_.width, conditions_[f].gain, -1, 0);
        ExpectRow(others, 0, frames_.size() - 1, y, by_others);
      }
      histograms.Add(by_others, frames_[f].image.view(), conditions_[f].gain);
    }
    thresholds_ = histograms.At(detection_rate);
  }

  std::span<const BackgroundFrame> frames_;  // Only while learning.
  std::vector<Conditions> conditions_;
  ColorSums sums_;
  ExpectedHalf half_;
  ExpectedPicture expected_;
  bool is_weighed_plainly_ = true;
  // Allocated on first use.
  ExpectedHalf displaced_half_;
  ExpectedPicture displaced_;
};

}  // namespace

std::unique_ptr<BackgroundModel> LearnFixedBackground(std::span<const BackgroundFrame> frames,
                                                      double detection_rate) {
  return std::make_unique<FixedBackground>(frames, detection_rate);
}

}  // namespace mocap

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/errors.h"
#include "core/reconstruction/background_model.h"
#include "core/reconstruction/coarse_scan.h"

namespace mocap {
namespace {

using Color = std::array<float, 3>;

// Below this [grey levels] rounding and the codec make the variation, not the sensor.
constexpr float kLeastSigma = 1.5f;
// So many frames fill the histograms well enough.
constexpr std::size_t kMostHistogramFrames = 16;

// What is summed up over the training frames for one pixel.
struct Sums {
  Color value{}, value_sq{};
  float alpha_shift_sq = 0;
  float cd_sq = 0;
};

// What a pixel is taken to be, from its sums over `count` frames.
struct Statistics {
  Color mean, sigma;
  float alpha_variation;
};

Statistics StatisticsOf(const Sums& sums, float count) {
  Statistics s;
  for (int c = 0; c < 3; ++c) {
    s.mean[c] = sums.value[c] / count;
    const float variance = (sums.value_sq[c] / count - s.mean[c] * s.mean[c]) * count / (count - 1);
    s.sigma[c] = std::max(std::sqrt(std::max(variance, 0.0f)), kLeastSigma);
  }
  s.alpha_variation = std::sqrt(sums.alpha_shift_sq / count);
  // The variation of the chromaticity distortion is the square root of 2 where nothing but σ acts.
  const float widening = std::max(std::sqrt(sums.cd_sq / count / 2), 1.0f);
  for (float& sigma : s.sigma) sigma *= widening;
  return s;
}

class FixedBackground final : public BackgroundModel {
 public:
  FixedBackground(std::span<const BackgroundFrame> frames, double detection_rate)
      : frames_(frames),
        conditions_(frames.size()),
        sums_(frames[0].image.pixels().size()),
        half_(frames[0].image.width(), frames[0].image.height()),
        expected_(frames[0].image.width(), frames[0].image.height()) {
    MOCAP_CHECK(frames.size() >= 2);
    // Once to see how the light flickered, and once without the flicker.
    SumColors();
    Expect(sums_, count());
    LearnHalf();
    LearnConditions();
    SumColors();
    Expect(sums_, count());
    LearnHalf();
    LearnConditions();
    SumDistortions();
    LearnThresholds(detection_rate);
    Expect(sums_, count());
    frames_ = {};
    sums_ = {}, conditions_ = {};
  }

  const ExpectedHalf& Glance(const PanTiltAngles&, const Displacement& displacement) override {
    if (displacement == Displacement{}) return half_;
    if (displaced_half_.variance.empty())
      displaced_half_ = ExpectedHalf(expected_.width, expected_.height);
    displaced_half_.Displace(half_, displacement);
    displaced_half_.AverageTiles();
    return displaced_half_;
  }

  const ExpectedPicture& Expect(const Closeup& closeup, const Conditions& conditions) override {
    const bool is_displaced = !(conditions.displacement == Displacement{});
    const bool is_plain = !is_displaced && conditions.shift_px == 0;
    if (is_plain && is_weighed_plainly_) return expected_;
    if (is_displaced && displaced_.mean[0].empty())
      displaced_ = ExpectedPicture(expected_.width, expected_.height);
    ExpectedPicture& picture = is_displaced ? displaced_ : expected_;
    for (int y = 0; y < expected_.height; ++y) {
      for (const PixelRun& run : closeup.Measured(y)) {
        if (is_displaced)
          picture.Displace(expected_, conditions.displacement, y, run.begin, run.end);
        picture.Weigh(conditions.shift_px,
                      static_cast<std::size_t>(y) * expected_.width + run.begin,
                      run.end - run.begin);
      }
    }
    is_weighed_plainly_ = is_weighed_plainly_ && is_displaced;
    return picture;
  }

 private:
  float count() const { return static_cast<float>(frames_.size()); }

  Color ColorOf(std::size_t frame, std::size_t pixel) const {
    const Bgr& p = frames_[frame].image.pixels()[pixel];
    const auto& gain = conditions_[frame].gain;
    return {p.b * gain[0], p.g * gain[1], p.r * gain[2]};
  }

  void Expect(const std::vector<Sums>& sums, float frame_count) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const Statistics s = StatisticsOf(sums[i], frame_count);
      expected_.SetPixel(i, s.mean, s.sigma, s.alpha_variation);
      // What is left after σ was learned from so few frames shows at contours.
      const float shift = half_.usual_shift_px * expected_.slope[i];
      for (auto& variance : expected_.variance) variance[i] += shift * shift;
    }
    expected_.Weigh(0, 0, static_cast<int>(sums.size()));
  }

  void SumColors() {
    std::fill(sums_.begin(), sums_.end(), Sums{});
    for (std::size_t f = 0; f < frames_.size(); ++f)
      for (std::size_t i = 0; i < sums_.size(); ++i) AddColor(ColorOf(f, i), 1, sums_[i]);
  }

  static void AddColor(const Color& color, float times, Sums& sums) {
    for (int c = 0; c < 3; ++c) {
      sums.value[c] += times * color[c];
      sums.value_sq[c] += times * color[c] * color[c];
    }
  }

  // What the pixels of the half and of the slopes are, from those of the whole.
  void LearnHalf() {
    const int width = expected_.width;
    Image<Bgr> rounded(width, expected_.height);
    std::vector<float> brightness(sums_.size());
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      std::array<std::uint8_t, 3> color;
      for (int c = 0; c < 3; ++c) {
        color[c] = static_cast<std::uint8_t>(std::min(std::lround(expected_.mean[c][i]), 255L));
        brightness[i] += expected_.mean[c][i] / 3;
      }
      rounded.pixels()[i] = {color[0], color[1], color[2]};
    }
    expected_.slope = SlopeOf(brightness, width, expected_.height);
    half_.LearnFrom(rounded.view());
    for (int y = 0; y < expected_.height / 2; ++y) {
      for (int x = 0; x < width / 2; ++x) {
        const std::size_t i = static_cast<std::size_t>(2 * y) * width + 2 * x;
        float sum = 0;
        for (const auto& variance : expected_.variance)
          sum += variance[i] + variance[i + 1] + variance[i + width] + variance[i + width + 1];
        half_.variance[static_cast<std::size_t>(y) * half_.mean.width + x] = sum / 12;
      }
    }
    half_.AverageTiles();
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

  void SumDistortions() {
    for (std::size_t f = 0; f < frames_.size(); ++f)
      for (std::size_t i = 0; i < sums_.size(); ++i) AddDistortion(ColorOf(f, i), i, 1, sums_[i]);
  }

  void AddDistortion(const Color& color, std::size_t i, float times, Sums& sums) const {
    float along = 0, length_sq = 0, total_sq = 0;
    for (int c = 0; c < 3; ++c) {
      const float sigma = std::sqrt(expected_.variance[c][i]);
      const float z = color[c] / sigma;
      const float m = expected_.mean[c][i] / sigma;
      along += z * m;
      length_sq += m * m;
      total_sq += (z - m) * (z - m);
    }
    const float shift = along / length_sq - 1;
    sums.alpha_shift_sq += times * shift * shift;
    sums.cd_sq += times * std::max(total_sq - shift * shift * length_sq, 0.0f);
  }

  // Each frame is held against what the others alone would have taught.
  void LearnThresholds(double detection_rate) {
    DistortionHistograms histograms;
    const ExpectedPicture all = expected_;
    std::vector<Sums> others;
    const std::size_t used = std::min(frames_.size(), kMostHistogramFrames);
    for (std::size_t k = 0; k < used; ++k) {
      const std::size_t f = k * frames_.size() / used;
      others = sums_;
      for (std::size_t i = 0; i < others.size(); ++i) {
        AddColor(ColorOf(f, i), -1, others[i]);
        AddDistortion(ColorOf(f, i), i, -1, others[i]);
        others[i].alpha_shift_sq = std::max(others[i].alpha_shift_sq, 0.0f);
        others[i].cd_sq = std::max(others[i].cd_sq, 0.0f);
      }
      Expect(others, count() - 1);
      histograms.Add(expected_, frames_[f].image.view(), conditions_[f].gain);
      expected_ = all;
    }
    thresholds_ = histograms.At(detection_rate);
  }

  std::span<const BackgroundFrame> frames_;  // While learning.
  std::vector<Conditions> conditions_;
  std::vector<Sums> sums_;
  ExpectedHalf half_;
  ExpectedPicture expected_;
  bool is_weighed_plainly_ = true;
  // Made when they are needed.
  ExpectedHalf displaced_half_;
  ExpectedPicture displaced_;
};

}  // namespace

std::unique_ptr<BackgroundModel> LearnFixedBackground(std::span<const BackgroundFrame> frames,
                                                      double detection_rate) {
  return std::make_unique<FixedBackground>(frames, detection_rate);
}

}  // namespace mocap

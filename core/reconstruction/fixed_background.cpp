#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/errors.h"
#include "core/reconstruction/background_model.h"

namespace mocap {
namespace {

using Color = std::array<float, 3>;

// Below this [grey levels] rounding and the codec make the variation, not the sensor.
constexpr float kLeastSigma = 1.5f;
// So many frames fill the histograms well enough.
constexpr std::size_t kMostHistogramFrames = 16;

Color ColorOf(const Bgr& p) {
  return {static_cast<float>(p.b), static_cast<float>(p.g), static_cast<float>(p.r)};
}

class FixedBackground final : public BackgroundModel {
 public:
  FixedBackground(std::span<const BackgroundFrame> frames, double detection_rate)
      : frames_(frames),
        size_(frames[0].image.pixels().size()),
        gains_(frames.size(), 1.0f),
        expected_(frames[0].image.width(), frames[0].image.height()) {
    MOCAP_CHECK(frames.size() >= 2);
    // Once to see how the light flickered, and once without the flicker.
    LearnColors();
    LearnGains();
    LearnColors();
    LearnVariation();
    LearnThresholds(detection_rate);
    for (std::size_t i = 0; i < size_; ++i)
      expected_.SetPixel(i, means_[i], sigmas_[i], alpha_variations_[i]);
    frames_ = {};
    means_ = {}, sigmas_ = {}, alpha_variations_ = {};
  }

  const ExpectedPicture& Expect(const PanTiltAngles&) override { return expected_; }

 private:
  float count() const { return static_cast<float>(frames_.size()); }

  void LearnColors() {
    means_.assign(size_, {});
    sigmas_.assign(size_, {});
    alpha_variations_.assign(size_, 0);
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const Bgr* pixels = frames_[f].image.pixels().data();
      for (std::size_t i = 0; i < size_; ++i) {
        const Color color = ColorOf(pixels[i]);
        for (int c = 0; c < 3; ++c) {
          const float value = color[c] * gains_[f];
          means_[i][c] += value;
          sigmas_[i][c] += value * value;
        }
      }
    }
    for (std::size_t i = 0; i < size_; ++i) {
      for (int c = 0; c < 3; ++c) {
        const float mean = means_[i][c] / count();
        const float variance = (sigmas_[i][c] / count() - mean * mean) * count() / (count() - 1);
        means_[i][c] = mean;
        sigmas_[i][c] = std::max(std::sqrt(std::max(variance, 0.0f)), kLeastSigma);
      }
      expected_.SetPixel(i, means_[i], sigmas_[i], 0);
    }
  }

  void LearnGains() {
    std::vector<float> scratch;
    for (std::size_t f = 0; f < frames_.size(); ++f)
      gains_[f] = MeasureGain(expected_, frames_[f].image.view(), scratch);
  }

  // The variations a of the brightness and b of the chromaticity distortion; b, which is the square
  // root of 2 where nothing but σ acts, widens σ.
  void LearnVariation() {
    std::vector<float> cd_sq(size_);
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const Bgr* pixels = frames_[f].image.pixels().data();
      for (std::size_t i = 0; i < size_; ++i) {
        const Color color = ColorOf(pixels[i]);
        float along = 0, length_sq = 0, total_sq = 0;
        for (int c = 0; c < 3; ++c) {
          const float z = color[c] * gains_[f] / sigmas_[i][c];
          const float m = expected_.scaled_mean[c][i];
          along += z * m;
          length_sq += m * m;
          total_sq += (z - m) * (z - m);
        }
        const float shift = along / length_sq - 1;
        alpha_variations_[i] += shift * shift;
        cd_sq[i] += std::max(total_sq - shift * shift * length_sq, 0.0f);
      }
    }
    for (std::size_t i = 0; i < size_; ++i) {
      alpha_variations_[i] = std::sqrt(alpha_variations_[i] / count());
      const float widening = std::max(std::sqrt(cd_sq[i] / count() / 2), 1.0f);
      for (float& sigma : sigmas_[i]) sigma *= widening;
    }
  }

  void LearnThresholds(double detection_rate) {
    DistortionHistograms histograms;
    const std::size_t used = std::min(frames_.size(), kMostHistogramFrames);
    for (std::size_t k = 0; k < used; ++k) {
      const std::size_t f = k * frames_.size() / used;
      const Bgr* pixels = frames_[f].image.pixels().data();
      for (std::size_t i = 0; i < size_; ++i) {
        const Color color = ColorOf(pixels[i]);
        Color others;
        for (int c = 0; c < 3; ++c)
          others[c] = (means_[i][c] * count() - color[c] * gains_[f]) / (count() - 1);
        expected_.SetPixel(i, others, sigmas_[i], alpha_variations_[i]);
      }
      histograms.Add(expected_, frames_[f].image.view());
    }
    thresholds_ = histograms.At(detection_rate);
  }

  std::span<const BackgroundFrame> frames_;  // While learning.
  std::size_t size_;
  std::vector<float> gains_;
  std::vector<Color> means_, sigmas_;
  std::vector<float> alpha_variations_;
  ExpectedPicture expected_;
};

}  // namespace

std::unique_ptr<BackgroundModel> LearnFixedBackground(std::span<const BackgroundFrame> frames,
                                                      double detection_rate) {
  return std::make_unique<FixedBackground>(frames, detection_rate);
}

}  // namespace mocap

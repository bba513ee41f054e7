#include "core/reconstruction/background_model.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr float kLeastSigma = 1.5f;
constexpr float kDarkestShadow = 0.55f;

// The value that all but a share of 1 - rate of the values do not exceed.
float Quantile(std::vector<float>& values, double rate) {
  const auto rank = std::min(static_cast<std::size_t>(rate * static_cast<double>(values.size())),
                             values.size() - 1);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank),
                   values.end());
  return values[rank];
}

}  // namespace

BackgroundModel::Distortion BackgroundModel::Distort(const Pixel& m, const Bgr& p, float gain) {
  const float color[3] = {p.b * gain, p.g * gain, p.r * gain};
  float along = 0, length = 0;
  for (int c = 0; c < 3; ++c) {
    const float weight = m.mean[c] * m.inverse_sigma[c] * m.inverse_sigma[c];
    along += color[c] * weight;
    length += m.mean[c] * weight;
  }
  const float alpha = along / length;
  float cd = 0;
  for (int c = 0; c < 3; ++c) {
    const float d = (color[c] - alpha * m.mean[c]) * m.inverse_sigma[c];
    cd += d * d;
  }
  return {alpha, std::sqrt(cd)};
}

float BackgroundModel::GainOf(ImageView<const Bgr> image) const {
  std::vector<float> ratios;
  for (int y = 2; y < height_; y += 5)
    for (int x = 2; x < width_; x += 5)
      ratios.push_back(
          Distort(pixels_[static_cast<std::size_t>(y) * width_ + x], image(x, y), 1).alpha);
  return 1 / std::max(Quantile(ratios, 0.5), 0.1f);
}

BackgroundModel::BackgroundModel(std::span<const Image<Bgr>* const> frames, double detection_rate)
    : width_(frames[0]->width()), height_(frames[0]->height()) {
  MOCAP_CHECK(frames.size() >= 2);
  const auto count = static_cast<float>(frames.size());
  const std::size_t size = static_cast<std::size_t>(width_) * height_;
  pixels_.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    float sum[3] = {}, sum_sq[3] = {};
    for (const Image<Bgr>* frame : frames) {
      const Bgr& p = frame->pixels()[i];
      const float color[3] = {static_cast<float>(p.b), static_cast<float>(p.g),
                              static_cast<float>(p.r)};
      for (int c = 0; c < 3; ++c) sum[c] += color[c], sum_sq[c] += color[c] * color[c];
    }
    for (int c = 0; c < 3; ++c) {
      const float mean = sum[c] / count;
      const float variance = std::max(0.0f, sum_sq[c] / count - mean * mean) * count / (count - 1);
      pixels_[i].mean[c] = std::max(mean, 1.0f);
      pixels_[i].inverse_sigma[c] = 1 / std::max(std::sqrt(variance), kLeastSigma);
    }
  }
  std::vector<float> gains;
  for (const Image<Bgr>* frame : frames) gains.push_back(GainOf(frame->view()));
  std::vector<float> low, high, cds;
  for (std::size_t i = 0; i < size; ++i) {
    float alpha_sq = 0, cd_sq = 0;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const Distortion d = Distort(pixels_[i], frames[f]->pixels()[i], gains[f]);
      alpha_sq += (d.alpha - 1) * (d.alpha - 1);
      cd_sq += d.cd * d.cd;
    }
    pixels_[i].inverse_alpha_variation = 1 / std::max(std::sqrt(alpha_sq / count), 0.008f);
    pixels_[i].inverse_cd_variation = 1 / std::max(std::sqrt(cd_sq / count), 0.7f);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const Distortion d = Distort(pixels_[i], frames[f]->pixels()[i], gains[f]);
      const float alpha = (d.alpha - 1) * pixels_[i].inverse_alpha_variation;
      low.push_back(-alpha);
      high.push_back(alpha);
      cds.push_back(d.cd * pixels_[i].inverse_cd_variation);
    }
  }
  alpha_low_ = -Quantile(low, detection_rate);
  alpha_high_ = Quantile(high, detection_rate);
  cd_threshold_ = Quantile(cds, detection_rate);
}

void BackgroundModel::Classify(ImageView<const Bgr> image, Image<std::uint8_t>& classes) const {
  const float gain = GainOf(image);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Pixel& m = pixels_[static_cast<std::size_t>(y) * width_ + x];
      const Distortion d = Distort(m, image(x, y), gain);
      const float alpha = (d.alpha - 1) * m.inverse_alpha_variation;
      PixelClass c = PixelClass::kHighlight;
      if (d.cd * m.inverse_cd_variation > cd_threshold_ || d.alpha < kDarkestShadow)
        c = PixelClass::kForeground;
      else if (alpha >= alpha_low_ && alpha <= alpha_high_)
        c = PixelClass::kBackground;
      else if (alpha < 0)
        c = PixelClass::kShadow;
      classes(x, y) = static_cast<std::uint8_t>(c);
    }
  }
}

}  // namespace mocap

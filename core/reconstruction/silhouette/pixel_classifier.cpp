#include "core/reconstruction/silhouette/pixel_classifier.h"

#include <algorithm>

#include "core/reconstruction/silhouette/bit_filters.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

// All of them drift alike when the brightness does.
constexpr float kChannels = 3;

constexpr float Square(float x) { return x * x; }

struct Measured {
  const float *alpha_shift, *alpha_weight, *cd_sq, *roughness_sq;
  const float* inverse_sigma;
};

// What is dark is so in itself and for background.
struct Darkness {
  float shift;  // α − 1.
  float normalized;
};

MOCAP_VECTORIZED
void MarkPixels(const Measured& m, int count, const Darkness& dark, float cd_sq, float drift,
                std::uint8_t* marks) {
  const auto [alpha_shift, alpha_weight, cds_sq, roughnesses_sq, inverse_sigma] = m;
  const auto [darkest, low] = dark;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float shift = alpha_shift[x];
    const float normalized_drift = drift * inverse_sigma[x];
    const int is_dark = (shift < darkest ? 1 : 0) & (shift * alpha_weight[x] < low ? 1 : 0);
    const int is_tinted = cds_sq[x] > cd_sq + normalized_drift * normalized_drift ? 1 : 0;
    marks[x] = static_cast<std::uint8_t>(is_dark | is_tinted);
  }
}

// Marks what exceeds a threshold, and in `clear` what exceeds it by the factor `margin`. Drift is
// the same all over a window: averaging does not lessen it, and it makes nothing rough.
MOCAP_VECTORIZED
void MarkWindows(const Measured& m, int count, const Darkness& dark,
                 const DistortionThresholds::Window& thresholds, float margin, float drift,
                 std::uint8_t* marks, std::uint8_t* clear) {
  const auto [alpha_shift, alpha_weight, cds_sq, roughnesses_sq, inverse_sigma] = m;
  const auto [darkest, low] = dark;
  const float per_cd = 1 / Square(thresholds.cd), per_alpha = 1 / Square(thresholds.alpha);
  const float per_roughness = 1 / Square(thresholds.roughness);
  const float margin_sq = Square(margin);
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float shift = alpha_shift[x];
    const float normalized = shift * alpha_weight[x];
    const float bright = std::max(normalized, 0.0f);
    const float drift_sq = drift * inverse_sigma[x] * (drift * inverse_sigma[x]);
    const int is_dark = (shift < darkest ? 1 : 0) & (normalized < low ? 1 : 0);
    const float excess_sq = std::max(std::max((cds_sq[x] - drift_sq) * per_cd,
                                              (bright * bright - kChannels * drift_sq) * per_alpha),
                                     roughnesses_sq[x] * per_roughness);
    marks[x] = static_cast<std::uint8_t>(is_dark | (excess_sq > 1 ? 1 : 0));
    clear[x] = static_cast<std::uint8_t>(is_dark | (excess_sq > margin_sq ? 1 : 0));
  }
}

}  // namespace

PixelClassifier::PixelClassifier(const DistortionThresholds& thresholds, float darkest_shadow)
    : thresholds_(thresholds), darkest_shadow_(darkest_shadow) {}

void PixelClassifier::Classify(const ExpectedPicture& expected, ImageView<const Bgr> image,
                               const Conditions& conditions, const Closeup& closeup) {
  const int width = image.width();
  const int height = image.height();
  if (alpha_shift_.width() != width || alpha_shift_.height() != height) {
    alpha_shift_ = Image<float>(width, height);
    clear_row_.resize(static_cast<std::size_t>(width));
    doubtful_row_.resize(static_cast<std::size_t>(width));
  }
  expected_ = &expected;
  drift_ = conditions.drift;
  clear_pixels_.Reset(width, height);
  for (auto* windows : {&clear_windows_, &doubtful_windows_})
    for (Silhouette& s : *windows) s.Reset(width, height);
  scan_.Begin(expected, image, conditions.gain, closeup);
  for (int y = 0; y < height; ++y) {
    const DistortionScan::Row& row = scan_.Next();
    for (const PixelRun& run : closeup.Measured(y))
      std::copy(row.alpha_shift + run.begin, row.alpha_shift + run.end,
                alpha_shift_.row(y) + run.begin);
    for (const PixelRun& run : closeup.Judged(y)) {
      ClassifyPixels(y, run, row);
      for (std::size_t k = 0; k < DistortionScan::kWindows; ++k) ClassifyWindows(y, run, k, row);
    }
  }
  // A pixel is background when any of the windows with it is, and may well be foreground when no
  // window of one size at least is.
  foreground_ = clear_pixels_;
  doubtful_ = clear_pixels_;
  for (std::size_t k = 0; k < DistortionScan::kWindows; ++k) {
    Erode(clear_windows_[k], DistortionScan::kRadii_px[k], eroded_[k]);
    Erode(doubtful_windows_[k], DistortionScan::kRadii_px[k], clear_windows_[k]);
    Unite(clear_windows_[k], doubtful_);
  }
  Intersect(eroded_[1], eroded_[0]);
  Unite(eroded_[0], foreground_);
}

PixelClass PixelClassifier::ClassOf(int x, int y) const {
  if (foreground_.Test(x, y)) return PixelClass::kForeground;
  const float normalized = alpha_shift_(x, y) * expected_->AlphaWeightAt(x, y);
  if (normalized < thresholds_.alpha_low) return PixelClass::kShadow;
  return normalized > thresholds_.alpha_high ? PixelClass::kHighlight : PixelClass::kBackground;
}

void PixelClassifier::ClassifyPixels(int y, const PixelRun& run, const DistortionScan::Row& row) {
  const auto count = static_cast<std::size_t>(run.end - run.begin);
  MarkPixels({row.alpha_shift + run.begin, row.alpha_weight + run.begin, row.cd_sq + run.begin,
              nullptr, row.inverse_sigma + run.begin},
             run.end - run.begin, {darkest_shadow_ - 1, kPixelMargin * thresholds_.alpha_low},
             Square(kPixelMargin * thresholds_.cd), drift_, clear_row_.data());
  PackRow({clear_row_.data(), count}, run.begin, clear_pixels_.row(y));
}

void PixelClassifier::ClassifyWindows(int y, const PixelRun& run, std::size_t k,
                                      const DistortionScan::Row& row) {
  const DistortionScan::Windows& w = row.windows[k];
  const DistortionThresholds::Window& t = thresholds_.windows[k];
  const auto count = static_cast<std::size_t>(run.end - run.begin);
  MarkWindows({w.alpha_shift + run.begin, row.alpha_weight + run.begin, w.cd_sq + run.begin,
               w.roughness_sq + run.begin, row.inverse_sigma + run.begin},
              run.end - run.begin, {darkest_shadow_ - 1, -kWindowMargins[k] * t.alpha}, t,
              kWindowMargins[k], drift_, doubtful_row_.data(), clear_row_.data());
  PackRow({doubtful_row_.data(), count}, run.begin, doubtful_windows_[k].row(y));
  PackRow({clear_row_.data(), count}, run.begin, clear_windows_[k].row(y));
}

}  // namespace mocap

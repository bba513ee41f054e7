#include "core/reconstruction/pixel_classifier.h"

#include <algorithm>

#include "core/reconstruction/bit_filters.h"

namespace mocap {
namespace {

// What an empty studio does not show: tints of shadows, and the noise that a codec lets through
// only where something moves. Measured on takes with true masks; a tenth more or less serves as
// well. The larger windows average noise away, so their thresholds lie closer to the middle.
constexpr std::array<float, DistortionScan::kWindows> kWindowMargins = {1.1f, 1.35f};
// One pixel alone must differ more, for there are many of them.
constexpr float kPixelMargin = 1.6f;

float Square(float x) { return x * x; }

}  // namespace

PixelClassifier::PixelClassifier(const DistortionThresholds& thresholds, float darkest_shadow)
    : thresholds_(thresholds), darkest_shadow_(darkest_shadow) {}

void PixelClassifier::Classify(const ExpectedPicture& expected, ImageView<const Bgr> image,
                               float gain) {
  const int width = image.width();
  const int height = image.height();
  if (classes_.width() != width || classes_.height() != height) {
    classes_ = Image<PixelClass>(width, height);
    alpha_shift_ = Image<float>(width, height);
    clear_row_.resize(static_cast<std::size_t>(width));
    doubtful_row_.resize(static_cast<std::size_t>(width));
  }
  clear_pixels_.Reset(width, height);
  for (auto* windows : {&clear_windows_, &doubtful_windows_})
    for (Silhouette& s : *windows) s.Reset(width, height);
  scan_.Begin(expected, image, gain);
  for (int y = 0; y < height; ++y) {
    const DistortionScan::Row& row = scan_.Next();
    ClassifyPixels(y, row);
    for (std::size_t k = 0; k < DistortionScan::kWindows; ++k) ClassifyWindows(y, k, row);
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
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (foreground_.Test(x, y)) classes_(x, y) = PixelClass::kForeground;
}

void PixelClassifier::ClassifyPixels(int y, const DistortionScan::Row& row) {
  const int width = classes_.width();
  const float darkest = darkest_shadow_ - 1;
  const float clear_cd_sq = Square(kPixelMargin * thresholds_.cd);
  const float clear_dark = kPixelMargin * thresholds_.alpha_low;
  const float low = thresholds_.alpha_low;
  const float high = thresholds_.alpha_high;
  const float* const cd_sq = row.cd_sq;
  const float* const inverse_variation = row.inverse_alpha_variation;
  auto* const classes = reinterpret_cast<std::uint8_t*>(classes_.row(y));
  std::uint8_t* const clear = clear_row_.data();
  std::copy(row.alpha_shift, row.alpha_shift + width, alpha_shift_.row(y));
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    const float shift = row.alpha_shift[x];
    const float normalized = shift * inverse_variation[x];
    clear[x] = (cd_sq[x] > clear_cd_sq) | ((shift < darkest) & (normalized < clear_dark));
    // Shadow is 1, highlight 2.
    classes[x] = static_cast<std::uint8_t>((normalized < low) + 2 * (normalized > high));
  }
  PackRow(clear_row_, clear_pixels_.row(y));
}

void PixelClassifier::ClassifyWindows(int y, std::size_t k, const DistortionScan::Row& row) {
  const int width = classes_.width();
  const DistortionThresholds::Window& t = thresholds_.windows[k];
  const float margin = kWindowMargins[k];
  const float darkest = darkest_shadow_ - 1;
  const float alpha = t.alpha, clear_alpha = margin * t.alpha;
  const float cd_sq = Square(t.cd), clear_cd_sq = Square(margin * t.cd);
  const float roughness_sq = Square(t.roughness);
  const float clear_roughness_sq = Square(margin * t.roughness);
  const DistortionScan::Windows& w = row.windows[k];
  const float* const inverse_variation = row.inverse_alpha_variation;
  std::uint8_t* const clear = clear_row_.data();
  std::uint8_t* const doubtful = doubtful_row_.data();
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    const float shift = w.alpha_shift[x];
    const float normalized = shift * inverse_variation[x];
    const bool dark = (shift < darkest) & (normalized < -clear_alpha);
    clear[x] = dark | (normalized > clear_alpha) | (w.cd_sq[x] > clear_cd_sq) |
               (w.roughness_sq[x] > clear_roughness_sq);
    doubtful[x] =
        dark | (normalized > alpha) | (w.cd_sq[x] > cd_sq) | (w.roughness_sq[x] > roughness_sq);
  }
  PackRow(clear_row_, clear_windows_[k].row(y));
  PackRow(doubtful_row_, doubtful_windows_[k].row(y));
}

}  // namespace mocap

#include "core/reconstruction/pixel_classifier.h"

#include <algorithm>

#include "core/reconstruction/bit_filters.h"

namespace mocap {
namespace {

// What an empty studio does not show: tints of shadows, and the noise that a codec lets through
// only where something moves. Measured on takes with true masks; 1.2 to 1.3 serve as well.
constexpr float kMargin = 1.25f;
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
    for (auto* row : {&pixel_, &clear_, &doubtful_row_}) row->resize(width);
  }
  for (Silhouette* s : {&pixels_, &windows_, &doubtful_windows_}) s->Reset(width, height);
  scan_.Begin(expected, image, gain);
  for (int y = 0; y < height; ++y) {
    ClassifyRow(y, scan_.Next());
    PackRow(pixel_, pixels_.row(y));
    PackRow(clear_, windows_.row(y));
    PackRow(doubtful_row_, doubtful_windows_.row(y));
  }
  // A pixel is background when any of the windows with it is.
  Erode(windows_, DistortionScan::kRadius_px, foreground_);
  Erode(doubtful_windows_, DistortionScan::kRadius_px, doubtful_);
  Unite(pixels_, foreground_);
  Unite(pixels_, doubtful_);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (foreground_.Test(x, y)) classes_(x, y) = PixelClass::kForeground;
}

void PixelClassifier::ClassifyRow(int y, const DistortionScan::Row& row) {
  const int width = classes_.width();
  const float darkest = darkest_shadow_ - 1;
  const float pixel_cd_sq = Square(kPixelMargin * thresholds_.cd);
  const float pixel_dark = kPixelMargin * thresholds_.alpha_low;
  const float cd_sq = Square(thresholds_.window_cd);
  const float alpha = thresholds_.window_alpha;
  const float roughness_sq = Square(thresholds_.window_roughness);
  const float alpha_low = thresholds_.alpha_low;
  const float alpha_high = thresholds_.alpha_high;
  auto* const classes = reinterpret_cast<std::uint8_t*>(classes_.row(y));
  std::uint8_t* const pixel = pixel_.data();
  std::uint8_t* const clear = clear_.data();
  std::uint8_t* const doubtful = doubtful_row_.data();
  std::copy(row.alpha_shift, row.alpha_shift + width, alpha_shift_.row(y));
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    const float shift = row.alpha_shift[x];
    const float normalized = shift * row.inverse_alpha_variation[x];
    pixel[x] = (row.cd_sq[x] > pixel_cd_sq) | ((shift < darkest) & (normalized < pixel_dark));
    classes[x] =
        static_cast<std::uint8_t>((normalized < alpha_low) * 1 + (normalized > alpha_high) * 2);
  }
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    const float shift = row.window_alpha_shift[x];
    const float normalized = shift * row.inverse_alpha_variation[x];
    const bool dark = (shift < darkest) & (normalized < -kMargin * alpha);
    clear[x] = dark | (normalized > kMargin * alpha) |
               (row.window_cd_sq[x] > kMargin * kMargin * cd_sq) |
               (row.window_roughness_sq[x] > kMargin * kMargin * roughness_sq);
    doubtful[x] = dark | (normalized > alpha) | (row.window_cd_sq[x] > cd_sq) |
                  (row.window_roughness_sq[x] > roughness_sq);
  }
}

}  // namespace mocap

#include "core/reconstruction/silhouette/pixel_classifier.h"

#include <algorithm>
#include <bit>

#include "core/kernels/windows.h"
#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {
namespace {

constexpr float Square(float x) { return x * x; }

kernels::WindowLimits LimitsOf(const DistortionThresholds::Window& thresholds, float margin,
                               float darkest_shift) {
  return {{darkest_shift, -margin * thresholds.alpha},
          1 / Square(thresholds.cd),
          1 / Square(thresholds.alpha),
          1 / Square(thresholds.roughness),
          Square(margin)};
}

std::uint8_t* BytesOf(std::uint64_t* words) {
  static_assert(std::endian::native == std::endian::little);
  return reinterpret_cast<std::uint8_t*>(words);
}

}  // namespace

PixelClassifier::PixelClassifier(const DistortionThresholds& thresholds, float darkest_shadow)
    : thresholds_(thresholds), darkest_shadow_(darkest_shadow) {}

void PixelClassifier::Classify(const ExpectedPicture& expected, ImageView<const Bgr> image,
                               const Conditions& conditions, const RegionOfInterest& roi) {
  expected_ = &expected;
  Resize(roi);
  scan_.Begin(expected, image, conditions.gain, roi);
  const float darkest = darkest_shadow_ - 1;
  const kernels::DistortionLimits limits{
      {{darkest, kPixelMargin * thresholds_.alpha_low}, Square(kPixelMargin * thresholds_.cd)},
      {LimitsOf(thresholds_.windows[0], kWindowMargins[0], darkest),
       LimitsOf(thresholds_.windows[1], kWindowMargins[1], darkest)},
      conditions.drift};
  // From a row's first pixel in the picture on.
  const auto bytes_of = [this](int y) {
    const auto row_of = [this, y](Silhouette& s) {
      return BytesOf(s.row(y - frame_.top)) - frame_.left / kernels::kBlock_px;
    };
    kernels::DecisionBytes bytes{row_of(clear_pixels_), row_of(dark_), {}, {}};
    for (std::size_t k = 0; k < kernels::kWindows; ++k) {
      bytes.doubtful[k] = row_of(doubtful_windows_[k]);
      bytes.clear[k] = row_of(clear_windows_[k]);
    }
    return bytes;
  };
  for (int y = frame_.top; y <= frame_.bottom; y += 2) {
    const DistortionScan::RowPair& pair = scan_.Next();
    const int rows = std::min(2, frame_.bottom + 1 - y);
    const std::array<kernels::DecisionBytes, 2> to = {bytes_of(y), bytes_of(y + rows - 1)};
    for (const PixelRun& run : roi.Judged(y))
      kernels::JudgeWindows(pair, run.begin, run.end, limits, to, rows);
  }
  // A pixel is background if any window that contains it is. It may be foreground if, for at least
  // one window size, no such window is background.
  foreground_ = clear_pixels_;
  doubtful_ = clear_pixels_;
  for (std::size_t k = 0; k < kernels::kWindows; ++k) {
    Erode(clear_windows_[k], kernels::kWindowRadii_px[k], eroded_[k]);
    Erode(doubtful_windows_[k], kernels::kWindowRadii_px[k], clear_windows_[k]);
    Unite(clear_windows_[k], doubtful_);
  }
  Intersect(eroded_[1], eroded_[0]);
  Unite(eroded_[0], foreground_);
}

void PixelClassifier::Resize(const RegionOfInterest& roi) {
  frame_ = roi.frame();
  for (auto* windows : {&clear_windows_, &doubtful_windows_, &eroded_})
    for (Silhouette& s : *windows) s.Reserve(roi.width(), roi.height());
  for (Silhouette* s : {&clear_pixels_, &foreground_, &doubtful_, &dark_})
    s->Reserve(roi.width(), roi.height());
  const int width = frame_.right - frame_.left + 1, height = frame_.bottom - frame_.top + 1;
  clear_pixels_.Reset(width, height);
  dark_.Reset(width, height);
  for (auto* windows : {&clear_windows_, &doubtful_windows_})
    for (Silhouette& s : *windows) s.Reset(width, height);
}

PixelClass PixelClassifier::ClassOf(int x, int y) const {
  const int u = x - frame_.left, v = y - frame_.top;
  if (u >= 0 && v >= 0 && u < foreground_.width() && v < foreground_.height() &&
      foreground_.Test(u, v))
    return PixelClass::kForeground;
  const float normalized = scan_.alpha_shift()(x, y) * expected_->AlphaWeightAt(x, y);
  if (normalized < thresholds_.alpha_low) return PixelClass::kShadow;
  return normalized > thresholds_.alpha_high ? PixelClass::kHighlight : PixelClass::kBackground;
}

}  // namespace mocap

#include "core/reconstruction/silhouette/pixel_classifier.h"

#include <bit>

#include "core/kernels/windows.h"
#include "core/reconstruction/silhouette/bit_filters.h"
#include "core/reconstruction/silhouette/segmentation_constants.h"

namespace mocap {
namespace {

using namespace segmentation;

constexpr float Squared(float x) { return x * x; }

kernels::WindowLimits LimitsOf(const DistortionThresholds::Window& thresholds, float margin,
                               float darkest_shift) {
  return {{darkest_shift, -margin * thresholds.alpha},
          1 / Squared(thresholds.cd),
          1 / Squared(thresholds.alpha),
          1 / Squared(thresholds.roughness),
          Squared(margin)};
}

std::uint8_t* BytesOf(std::uint64_t* words) {
  static_assert(std::endian::native == std::endian::little);
  return reinterpret_cast<std::uint8_t*>(words);
}

}  // namespace

PixelClassifier::PixelClassifier(const DistortionThresholds& thresholds, float darkest_shadow) {
  const float darkest = darkest_shadow - 1;
  limits_.pixel = {{darkest, kPixelMargin * thresholds.alpha_low},
                   Squared(kPixelMargin * thresholds.cd)};
  for (std::size_t k = 0; k < kernels::kWindows; ++k)
    limits_.windows[k] = LimitsOf(thresholds.windows[k], kWindowMargins[k], darkest);
}

void PixelClassifier::Classify(const ExpectedPicture& expected, ImageView<const Bgr> image,
                               const Conditions& conditions, const RegionOfInterest& roi) {
  limits_.drift = conditions.drift;
  for (Silhouette* s : {&foreground_, &dark_, &clear_windows_[0], &clear_windows_[1],
                        &doubtful_windows_[0], &doubtful_windows_[1]})
    s->Reset(image.width(), image.height());
  scan_.Begin(expected, image, conditions.gain, roi);
  for (int y = 0; y < image.height(); y += 2) {
    const DistortionScan::RowPair& pair = scan_.Next();
    const int rows = std::min(2, image.height() - y);
    const std::array<kernels::DecisionBytes, 2> to = {BytesOfRow(y), BytesOfRow(y + rows - 1)};
    roi.ForEachJudged(y, [&](const PixelRun& run) {
      kernels::JudgeWindows(pair, run.begin, run.end, limits_, to, rows);
    });
  }
  // A pixel is background if any window that contains it is. It is doubtful if, for at least one
  // window size, no such window is background for sure.
  doubtful_ = foreground_;
  for (std::size_t k = 0; k < kernels::kWindows; ++k) {
    Erode(doubtful_windows_[k], kernels::kWindowRadii_px[k], eroded_);
    Unite(eroded_, doubtful_);
  }
  Erode(clear_windows_[0], kernels::kWindowRadii_px[0], eroded_);
  Erode(clear_windows_[1], kernels::kWindowRadii_px[1], eroded_too_);
  Intersect(eroded_too_, eroded_);
  Unite(eroded_, foreground_);
}

// The clear pixels are the first of the foreground.
kernels::DecisionBytes PixelClassifier::BytesOfRow(int y) {
  kernels::DecisionBytes bytes{BytesOf(foreground_.row(y)), BytesOf(dark_.row(y)), {}, {}};
  for (std::size_t k = 0; k < kernels::kWindows; ++k) {
    bytes.doubtful[k] = BytesOf(doubtful_windows_[k].row(y));
    bytes.clear[k] = BytesOf(clear_windows_[k].row(y));
  }
  return bytes;
}

}  // namespace mocap

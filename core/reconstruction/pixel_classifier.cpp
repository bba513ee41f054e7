#include "core/reconstruction/pixel_classifier.h"

#include <algorithm>
#include <limits>

#include "core/reconstruction/bit_filters.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

// What an empty studio does not show: tints of shadows, and the noise that a codec lets through
// only where something moves. Measured on takes with true masks; a tenth more or less serves as
// well. The larger windows average noise away, so their thresholds lie closer to the middle.
constexpr std::array<float, DistortionScan::kWindows> kWindowMargins = {1.1f, 1.35f};
// One pixel alone must differ more, for there are many of them.
constexpr float kPixelMargin = 1.6f;

constexpr float Square(float x) { return x * x; }

constexpr float kNoLimit = std::numeric_limits<float>::infinity();

struct Measured {
  const float *alpha_shift, *alpha_weight, *cd_sq, *roughness_sq;
};

// What is beyond one of them is marked; what is dark is so in itself and for background.
struct Limits {
  float darkest = kNoLimit;  // Of α − 1.
  float alpha_low = -kNoLimit;
  float alpha_high = kNoLimit;
  float cd_sq = kNoLimit;
  float roughness_sq = kNoLimit;
};

MOCAP_VECTORIZED
void MarkPixels(const Measured& m, int count, const Limits& limits, std::uint8_t* marks) {
  const auto [alpha_shift, alpha_weight, cds_sq, roughnesses_sq] = m;
  const auto [darkest, low, high, cd_sq, roughness_sq] = limits;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float shift = alpha_shift[x];
    const float normalized = shift * alpha_weight[x];
    const int dark = (shift < darkest ? 1 : 0) & (normalized < low ? 1 : 0);
    const int bright = normalized > high ? 1 : 0;
    const int tinted = cds_sq[x] > cd_sq ? 1 : 0;
    const int rough = roughnesses_sq[x] > roughness_sq ? 1 : 0;
    marks[x] = static_cast<std::uint8_t>(dark | bright | tinted | rough);
  }
}

}  // namespace

PixelClassifier::PixelClassifier(const DistortionThresholds& thresholds, float darkest_shadow)
    : thresholds_(thresholds), darkest_shadow_(darkest_shadow) {}

void PixelClassifier::Classify(const ExpectedPicture& expected, ImageView<const Bgr> image,
                               const std::array<float, 3>& gain, const Closeup& closeup) {
  const int width = image.width();
  const int height = image.height();
  if (alpha_shift_.width() != width || alpha_shift_.height() != height) {
    alpha_shift_ = Image<float>(width, height);
    marks_.resize(static_cast<std::size_t>(width));
  }
  clear_pixels_.Reset(width, height);
  for (auto* windows : {&clear_windows_, &doubtful_windows_})
    for (Silhouette& s : *windows) s.Reset(width, height);
  scan_.Begin(expected, image, gain, closeup);
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

PixelClass PixelClassifier::ClassOf(const ExpectedPicture& expected, int x, int y) const {
  if (foreground_.Test(x, y)) return PixelClass::kForeground;
  const float normalized =
      alpha_shift_(x, y) * expected.alpha_weight[static_cast<std::size_t>(y) * expected.width + x];
  if (normalized < thresholds_.alpha_low) return PixelClass::kShadow;
  return normalized > thresholds_.alpha_high ? PixelClass::kHighlight : PixelClass::kBackground;
}

void PixelClassifier::ClassifyPixels(int y, const PixelRun& run, const DistortionScan::Row& row) {
  const Measured measured{row.alpha_shift + run.begin, row.alpha_weight + run.begin,
                          row.cd_sq + run.begin, row.cd_sq + run.begin};
  const Limits clear{.darkest = darkest_shadow_ - 1,
                     .alpha_low = kPixelMargin * thresholds_.alpha_low,
                     .cd_sq = Square(kPixelMargin * thresholds_.cd)};
  MarkPixels(measured, run.end - run.begin, clear, marks_.data());
  PackRow({marks_.data(), static_cast<std::size_t>(run.end - run.begin)}, run.begin,
          clear_pixels_.row(y));
}

void PixelClassifier::ClassifyWindows(int y, const PixelRun& run, std::size_t k,
                                      const DistortionScan::Row& row) {
  const DistortionThresholds::Window& t = thresholds_.windows[k];
  const DistortionScan::Windows& w = row.windows[k];
  const Measured measured{w.alpha_shift + run.begin, row.alpha_weight + run.begin,
                          w.cd_sq + run.begin, w.roughness_sq + run.begin};
  const auto mark = [&](float margin, Silhouette& windows) {
    MarkPixels(measured, run.end - run.begin,
               // What is too dark for a shadow is not doubtful.
               {.darkest = darkest_shadow_ - 1,
                .alpha_low = -kWindowMargins[k] * t.alpha,
                .alpha_high = margin * t.alpha,
                .cd_sq = Square(margin * t.cd),
                .roughness_sq = Square(margin * t.roughness)},
               marks_.data());
    PackRow({marks_.data(), static_cast<std::size_t>(run.end - run.begin)}, run.begin,
            windows.row(y));
  };
  mark(kWindowMargins[k], clear_windows_[k]);
  mark(1, doubtful_windows_[k]);
}

}  // namespace mocap

#include "core/reconstruction/silhouette/pixel_classifier.h"

#include <algorithm>
#include <bit>

#include "core/lanes.h"
#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {
namespace {

// All channels drift alike when the brightness does.
constexpr float kChannels = 3;

constexpr float Square(float x) { return x * x; }

// Darkness, absolute and in units of the background's variation.
struct Darkness {
  float shift;  // α − 1.
  float normalized;
};

struct PixelCriteria {
  Darkness dark;
  float cd_sq;
};

struct WindowCriteria {
  WindowCriteria(const DistortionThresholds::Window& thresholds, float margin, float darkest_shift)
      : dark{darkest_shift, -margin * thresholds.alpha},
        per_cd(1 / Square(thresholds.cd)),
        per_alpha(1 / Square(thresholds.alpha)),
        per_roughness(1 / Square(thresholds.roughness)),
        margin_sq(Square(margin)) {}
  Darkness dark;
  float per_cd, per_alpha, per_roughness;
  float margin_sq;  // Above the threshold is doubtful, above threshold times margin is clear.
};

struct Criteria {
  PixelCriteria pixel;
  std::array<WindowCriteria, kWindows> windows;
  float drift;
};

// Results for the windows around eight pixels, as bits.
struct Decision {
  unsigned doubtful, clear;
  unsigned dark;  // As dark as shadows and some clothes.
};

// Drift is constant over a window: averaging does not reduce it, and it adds no roughness.
template <std::size_t window>
MOCAP_INLINE Decision JudgeWindows(const WindowDistortions& d, const Floats& alpha_weight,
                                   const Floats& drift_sq, const WindowCriteria& criteria) {
  const Floats normalized = d.alpha_shift * alpha_weight;
  const Floats bright = normalized > 0 ? normalized : Floats{};
  Floats excess_sq = (d.cd_sq - drift_sq) * criteria.per_cd;
  excess_sq = Most(excess_sq, (bright * bright - kChannels * drift_sq) * criteria.per_alpha);
  excess_sq = Most(excess_sq, d.roughness_sq * criteria.per_roughness);
  const Ints is_dark =
      (d.alpha_shift < criteria.dark.shift) & (normalized < criteria.dark.normalized);
  return {BitsOf(is_dark | (excess_sq > 1)), BitsOf(is_dark | (excess_sq > criteria.margin_sq)),
          BitsOf(normalized < criteria.dark.normalized)};
}

// Deviation of eight single pixels, and of the windows around them, from background.
struct Judgement {
  Floats alpha_weight, drift_sq;
  unsigned clear;
  std::array<Decision, kWindows> windows;
};

MOCAP_INLINE void JudgePixels(const DistortionScan::Row& row, int x, const Criteria& criteria,
                              Judgement& judgement) {
  Floats alpha_shift, alpha_weight, cd_sq, drift;
  LoadLanes(row.alpha_shift + x, alpha_shift), LoadLanes(row.alpha_weight + x, alpha_weight);
  LoadLanes(row.cd_sq + x, cd_sq), LoadLanes(row.inverse_sigma + x, drift);
  drift *= criteria.drift;
  const Floats drift_sq = drift * drift;
  const PixelCriteria& alone = criteria.pixel;
  const Ints is_dark =
      (alpha_shift < alone.dark.shift) & (alpha_shift * alpha_weight < alone.dark.normalized);
  judgement.alpha_weight = alpha_weight, judgement.drift_sq = drift_sq;
  judgement.clear = BitsOf(is_dark | (cd_sq > alone.cd_sq + drift_sq));
}

template <std::size_t window>
MOCAP_INLINE void JudgeWindows(const WindowLines& sums, int block, const Criteria& criteria,
                               std::array<Judgement, 2>& judgements) {
  std::array<WindowDistortions, 2> d;
  JoinLines<window>(sums, block, {judgements[0].alpha_weight, judgements[1].alpha_weight}, d);
#pragma GCC unroll 2
  for (int row = 0; row < 2; ++row)
    judgements[row].windows[window] = JudgeWindows<window>(
        d[row], judgements[row].alpha_weight, judgements[row].drift_sq, criteria.windows[window]);
}

std::uint8_t* BytesOf(std::uint64_t* words) {
  static_assert(std::endian::native == std::endian::little);
  return reinterpret_cast<std::uint8_t*>(words);
}

// Destination of the decisions on a row's pixels, eight per byte.
struct DecisionBytes {
  std::uint8_t *clear_pixels, *dark;
  std::array<std::uint8_t*, kWindows> doubtful, clear;

  MOCAP_INLINE void Set(int block, const Judgement& judgement, unsigned judged) const {
    clear_pixels[block] = static_cast<std::uint8_t>(judgement.clear & judged);
    dark[block] = static_cast<std::uint8_t>(judgement.windows[0].dark & judged);
#pragma GCC unroll 2
    for (std::size_t k = 0; k < kWindows; ++k) {
      doubtful[k][block] = static_cast<std::uint8_t>(judgement.windows[k].doubtful & judged);
      clear[k][block] = static_cast<std::uint8_t>(judgement.windows[k].clear & judged);
    }
  }
};

// Judges the pixels of a run in two rows, or only in the first.
MOCAP_VECTORIZED
void JudgeRun(const DistortionScan::RowPair& pair, const PixelRun& run, const Criteria& criteria,
              const std::array<DecisionBytes, 2>& to, int rows) {
  for (int block = run.begin / kFloats; block * kFloats < run.end; ++block) {
    std::array<Judgement, 2> judgements;
#pragma GCC unroll 2
    for (int row = 0; row < 2; ++row)
      JudgePixels(pair.rows[row], block * kFloats, criteria, judgements[row]);
    JudgeWindows<0>(pair.sums, block, criteria, judgements);
    JudgeWindows<1>(pair.sums, block, criteria, judgements);
    const unsigned judged = 0xffu >> std::max((block + 1) * kFloats - run.end, 0);
    to[0].Set(block, judgements[0], judged);
    if (rows == 2) to[1].Set(block, judgements[1], judged);
  }
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
  const Criteria criteria{
      {{darkest, kPixelMargin * thresholds_.alpha_low}, Square(kPixelMargin * thresholds_.cd)},
      {{{thresholds_.windows[0], kWindowMargins[0], darkest},
        {thresholds_.windows[1], kWindowMargins[1], darkest}}},
      conditions.drift};
  // From a row's first pixel in the picture on.
  const auto bytes_of = [this](int y) {
    const auto row_of = [this, y](Silhouette& s) {
      return BytesOf(s.row(y - frame_.top)) - frame_.left / kFloats;
    };
    DecisionBytes bytes{row_of(clear_pixels_), row_of(dark_), {}, {}};
    for (std::size_t k = 0; k < kWindows; ++k) {
      bytes.doubtful[k] = row_of(doubtful_windows_[k]);
      bytes.clear[k] = row_of(clear_windows_[k]);
    }
    return bytes;
  };
  for (int y = frame_.top; y <= frame_.bottom; y += 2) {
    const DistortionScan::RowPair& pair = scan_.Next();
    const int rows = std::min(2, frame_.bottom + 1 - y);
    const std::array<DecisionBytes, 2> to = {bytes_of(y), bytes_of(y + rows - 1)};
    for (const PixelRun& run : roi.Judged(y)) JudgeRun(pair, run, criteria, to, rows);
  }
  // A pixel is background if any window that contains it is. It may be foreground if, for at least
  // one window size, no such window is background.
  foreground_ = clear_pixels_;
  doubtful_ = clear_pixels_;
  for (std::size_t k = 0; k < kWindows; ++k) {
    Erode(clear_windows_[k], kWindowRadii_px[k], eroded_[k]);
    Erode(doubtful_windows_[k], kWindowRadii_px[k], clear_windows_[k]);
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

#include "core/reconstruction/silhouette/pixel_classifier.h"

#include <span>

#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {
namespace {

// All of them drift alike when the brightness does.
constexpr float kChannels = 3;

constexpr float Square(float x) { return x * x; }

// What is dark is so in itself and for background.
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
  float margin_sq;  // What exceeds a threshold is doubtful, what does so by the margin clear.
};

struct Criteria {
  PixelCriteria pixel;
  std::array<WindowCriteria, kWindows> windows;
  float drift;
};

// A bit a kind: pixels that cannot be background by themselves, and windows, doubtful and clear.
constexpr int kClearPixel = 1;
constexpr int DoubtfulWindow(std::size_t k) { return 2 << k; }
constexpr int ClearWindow(std::size_t k) { return 2 << (kWindows + k); }

// Drift is the same all over a window: averaging does not lessen it, and it makes nothing rough.
template <std::size_t window>
MOCAP_INLINE void MarkWindows(const WindowDistortions& d, const Floats& alpha_weight,
                              const Floats& drift_sq, const WindowCriteria& criteria, Ints& marks) {
  const Floats normalized = d.alpha_shift * alpha_weight;
  const Floats bright = normalized > 0 ? normalized : Floats{};
  Floats excess_sq = (d.cd_sq - drift_sq) * criteria.per_cd;
  excess_sq = Most(excess_sq, (bright * bright - kChannels * drift_sq) * criteria.per_alpha);
  excess_sq = Most(excess_sq, d.roughness_sq * criteria.per_roughness);
  const Ints is_dark =
      (d.alpha_shift < criteria.dark.shift) & (normalized < criteria.dark.normalized);
  marks |= (is_dark | (excess_sq > 1)) & DoubtfulWindow(window);
  marks |= (is_dark | (excess_sq > criteria.margin_sq)) & ClearWindow(window);
}

// How a pixel by itself, and the windows around it, would differ from background.
struct Judgement {
  Floats alpha_weight, drift_sq;
  Ints marks;
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
  judgement = {alpha_weight, drift_sq, (is_dark | (cd_sq > alone.cd_sq + drift_sq)) & kClearPixel};
}

template <std::size_t window>
MOCAP_INLINE void JudgeWindows(const WindowLines& sums, int block, const Criteria& criteria,
                               std::array<Judgement, 2>& judgements) {
  std::array<WindowDistortions, 2> d;
  JoinLines<window>(sums, block, {judgements[0].alpha_weight, judgements[1].alpha_weight}, d);
#pragma GCC unroll 2
  for (int row = 0; row < 2; ++row)
    MarkWindows<window>(d[row], judgements[row].alpha_weight, judgements[row].drift_sq,
                        criteria.windows[window], judgements[row].marks);
}

// Marks the pixels of blocks of two rows.
MOCAP_VECTORIZED
void MarkBlocks(const DistortionScan::RowPair& pair, int first, int blocks,
                const Criteria& criteria, const std::array<std::int32_t*, 2>& marks) {
  for (int block = first; block < first + blocks; ++block) {
    std::array<Judgement, 2> judgements;
#pragma GCC unroll 2
    for (int row = 0; row < 2; ++row)
      JudgePixels(pair.rows[row], block * kFloats, criteria, judgements[row]);
    JudgeWindows<0>(pair.sums, block, criteria, judgements);
    JudgeWindows<1>(pair.sums, block, criteria, judgements);
#pragma GCC unroll 2
    for (int row = 0; row < 2; ++row)
      StoreLanes(judgements[row].marks, marks[row] + (block - first) * kFloats);
  }
}

MOCAP_VECTORIZED
void Narrow(const std::int32_t* from, int count, std::uint8_t* to) {
  for (int i = 0; i < count; ++i) to[i] = static_cast<std::uint8_t>(from[i]);
}

}  // namespace

PixelClassifier::PixelClassifier(const DistortionThresholds& thresholds, float darkest_shadow)
    : thresholds_(thresholds), darkest_shadow_(darkest_shadow) {}

void PixelClassifier::Classify(const ExpectedPicture& expected, ImageView<const Bgr> image,
                               const Conditions& conditions, const Closeup& closeup) {
  expected_ = &expected;
  Resize(closeup);
  scan_.Begin(expected, image, conditions.gain, closeup);
  const float darkest = darkest_shadow_ - 1;
  const Criteria criteria{
      {{darkest, kPixelMargin * thresholds_.alpha_low}, Square(kPixelMargin * thresholds_.cd)},
      {{{thresholds_.windows[0], kWindowMargins[0], darkest},
        {thresholds_.windows[1], kWindowMargins[1], darkest}}},
      conditions.drift};
  for (int y = frame_.top; y <= frame_.bottom; y += 2) {
    const DistortionScan::RowPair& pair = scan_.Next();
    for (const PixelRun& run : closeup.Judged(y)) {
      const int count = run.end - run.begin;
      MarkBlocks(pair, run.begin / kFloats, (count + kFloats - 1) / kFloats, criteria,
                 {marks_[0].data(), marks_[1].data()});
      for (int row = 0; row < 2 && y + row <= frame_.bottom; ++row) Pack(marks_[row], run, y + row);
    }
  }
  // A pixel is background when any of the windows with it is, and may well be foreground when no
  // window of one size at least is.
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

void PixelClassifier::Pack(const std::vector<std::int32_t>& marks, const PixelRun& run, int y) {
  const int count = run.end - run.begin;
  Narrow(marks.data(), count, narrow_marks_.data());
  const std::span<const std::uint8_t> narrow(narrow_marks_.data(), static_cast<std::size_t>(count));
  const int begin = run.begin - frame_.left, to = y - frame_.top;
  PackRow(narrow, kClearPixel, begin, clear_pixels_.row(to));
  for (std::size_t k = 0; k < kWindows; ++k) {
    PackRow(narrow, DoubtfulWindow(k), begin, doubtful_windows_[k].row(to));
    PackRow(narrow, ClearWindow(k), begin, clear_windows_[k].row(to));
  }
}

void PixelClassifier::Resize(const Closeup& closeup) {
  frame_ = closeup.frame();
  for (auto* windows : {&clear_windows_, &doubtful_windows_, &eroded_})
    for (Silhouette& s : *windows) s.Reserve(closeup.width(), closeup.height());
  for (Silhouette* s : {&clear_pixels_, &foreground_, &doubtful_})
    s->Reserve(closeup.width(), closeup.height());
  const int width = frame_.right - frame_.left + 1, height = frame_.bottom - frame_.top + 1;
  clear_pixels_.Reset(width, height);
  for (auto* windows : {&clear_windows_, &doubtful_windows_})
    for (Silhouette& s : *windows) s.Reset(width, height);
  const auto row_px = static_cast<std::size_t>(closeup.width()) + kFloats;
  for (auto& marks : marks_) marks.resize(row_px);
  narrow_marks_.resize(row_px);
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

#include "core/kernels/windows.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/windows.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

// Part of a block that fits into a vector.
using D = FloatsUpTo<kBlock_px>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr std::size_t kLanes = hn::MaxLanes(D());

// All channels drift alike when the brightness does.
constexpr float kChannels = 3;
constexpr int kSmaller = kWindowRadii_px[0], kLarger = kWindowRadii_px[1];
static_assert(kWindows == 2 && kLarger == kSmaller + 1);

// Terms of sums. Not lambdas: compilers would not inline these into code for another target.
struct Itself {
  HWY_INLINE V operator()(V value, int) const { return value; }
};
struct SquareOf {
  HWY_INLINE V operator()(V value, int) const { return value * value; }
};
struct MomentOf {
  HWY_INLINE V operator()(V value, int to_right) const {
    return value * hn::Set(D(), static_cast<float>(to_right));
  }
};

// Values and their neighbours to the left and right.
struct Neighbours {
  HWY_INLINE explicit Neighbours(const float* values) {
    constexpr D d;
    for (int i = -kLarger; i <= kLarger; ++i) at[i + kLarger] = hn::LoadU(d, values + i);
  }
  V at[2 * kLarger + 1];
};

// Sums over the smaller width, and from there over the larger one, which is two pixels wider.
template <typename Term>
HWY_INLINE void SumBoth(const Neighbours& values, Term term, float* smaller, float* larger) {
  constexpr D d;
  V sum = hn::Zero(d);
  for (int i = kSmaller; i >= -kSmaller; --i) sum = term(values.at[i + kLarger], i) + sum;
  hn::StoreU(sum, d, smaller);
  hn::StoreU(sum + term(values.at[0], -kLarger) + term(values.at[2 * kLarger], kLarger), d, larger);
}

void SumBlocks(const float* alpha_shift, const std::array<const float*, 3>& cd, int row_step,
               int blocks, int rows, BlockSums* sums) {
  for (int block = 0; block < blocks; ++block) {
    for (int row = 0; row < rows; ++row) {
      auto& [smaller, larger] = sums[block * kSumLines + row];
      for (std::size_t k = 0; k < kBlock_px; k += kLanes) {
        const std::size_t x = block * kBlock_px + row * row_step + k;
        const Neighbours alphas(alpha_shift + x);
        SumBoth(alphas, Itself(), &smaller.alpha[k], &larger.alpha[k]);
        SumBoth(alphas, SquareOf(), &smaller.alpha_sq[k], &larger.alpha_sq[k]);
        SumBoth(alphas, MomentOf(), &smaller.moment[k], &larger.moment[k]);
        for (int c = 0; c < 3; ++c)
          SumBoth(Neighbours(cd[c] + x), Itself(), &smaller.cd[c][k], &larger.cd[c][k]);
      }
    }
  }
}

// Deviations of windows.
struct WindowDistortions {
  V alpha_shift;   // Mean of α − 1.
  V cd_sq;         // Squared length of the mean colour distance.
  V roughness_sq;  // Variance of α about a plane, divided by a².
};

// Sums over the lines of windows, from pixel `k` of a block on.
struct WindowSums {
  // The sums of one line, at a distance below the middle.
  HWY_INLINE WindowSums(const LineSums& line, std::size_t k, float below) {
    constexpr D d;
    alpha = hn::LoadU(d, &line.alpha[k]), alpha_sq = hn::LoadU(d, &line.alpha_sq[k]);
    along = hn::LoadU(d, &line.moment[k]), cd0 = hn::LoadU(d, &line.cd[0][k]);
    cd1 = hn::LoadU(d, &line.cd[1][k]), cd2 = hn::LoadU(d, &line.cd[2][k]);
    down = hn::Set(d, below) * alpha;
  }
  HWY_INLINE void Add(const WindowSums& line) {
    alpha = alpha + line.alpha, alpha_sq = alpha_sq + line.alpha_sq, along = along + line.along;
    down = down + line.down, cd0 = cd0 + line.cd0, cd1 = cd1 + line.cd1, cd2 = cd2 + line.cd2;
  }
  // Moves the middle down by `by`.
  HWY_INLINE void MoveMiddle(float by) { down = down - hn::Set(D(), by) * alpha; }

  V alpha, alpha_sq, along, down, cd0, cd1, cd2;
};

template <std::size_t window>
HWY_INLINE WindowDistortions MeasureWindow(const WindowSums& s, V alpha_weight) {
  constexpr int kSide = 2 * kWindowRadii_px[window] + 1;
  constexpr float kArea = kSide * kSide;
  // Sum of x² over the window's pixels, relative to its centre.
  constexpr float kSpread = kArea * (kArea - 1) / 12;
  constexpr D d;
  const V per_area = hn::Set(d, 1 / kArea);
  const V alpha_shift = s.alpha * per_area;
  const V squares = s.alpha_sq - s.alpha * alpha_shift -
                    (s.along * s.along + s.down * s.down) * hn::Set(d, 1 / kSpread);
  return {alpha_shift,
          (s.cd0 * s.cd0 + s.cd1 * s.cd1 + s.cd2 * s.cd2) * hn::Set(d, 1 / (kArea * kArea)),
          squares * per_area * alpha_weight * alpha_weight};
}

template <std::size_t window>
HWY_INLINE const LineSums& LineAt(const WindowLines& lines, int block, int below_first) {
  return lines[below_first + kLargestRadius_px][block * kSumLines][window];
}

// Of windows in two rows, one above the other.
struct WindowPair {
  WindowDistortions upper, lower;
};

// Measures the windows of one size around pixels of two rows, from pixel `k` of a block on. They
// share all but the outermost lines.
template <std::size_t window>
HWY_INLINE WindowPair JoinLines(const WindowLines& lines, int block, std::size_t k, V upper_weight,
                                V lower_weight) {
  constexpr int kRadius = kWindowRadii_px[window];
  // From the middle between the rows.
  WindowSums upper(LineAt<window>(lines, block, kRadius), k, kRadius - 0.5f);
  for (int i = kRadius - 1; i > -kRadius; --i)
    upper.Add(WindowSums(LineAt<window>(lines, block, i), k, static_cast<float>(i) - 0.5f));
  WindowSums lower = upper;
  upper.MoveMiddle(-0.5f), lower.MoveMiddle(0.5f);
  upper.Add(WindowSums(LineAt<window>(lines, block, -kRadius), k, -kRadius));
  lower.Add(WindowSums(LineAt<window>(lines, block, kRadius + 1), k, kRadius));
  return {MeasureWindow<window>(upper, upper_weight), MeasureWindow<window>(lower, lower_weight)};
}

// What pixels are judged by.
struct Judgement {
  V alpha_weight, drift_sq;
};
// Decisions on the pixels of a block.
struct Bits {
  unsigned clear_pixels = 0, dark = 0;
  std::array<unsigned, kWindows> doubtful{}, clear{};
};

// Drift is constant over a window: averaging does not reduce it, and it adds no roughness.
template <std::size_t window>
HWY_INLINE void JudgeWindow(const WindowDistortions& w, const Judgement& j,
                            const WindowLimits& limits, std::size_t k, Bits& bits) {
  constexpr D d;
  const V normalized = w.alpha_shift * j.alpha_weight;
  const V bright = Larger(hn::Zero(d), normalized);
  V excess_sq = (w.cd_sq - j.drift_sq) * hn::Set(d, limits.per_cd);
  excess_sq = Larger(excess_sq, (bright * bright - hn::Set(d, kChannels) * j.drift_sq) *
                                    hn::Set(d, limits.per_alpha));
  excess_sq = Larger(excess_sq, w.roughness_sq * hn::Set(d, limits.per_roughness));
  const M below = hn::Lt(normalized, hn::Set(d, limits.dark.normalized));
  const M is_dark = hn::And(hn::Lt(w.alpha_shift, hn::Set(d, limits.dark.shift)), below);
  bits.doubtful[window] |= BitsOf(d, hn::Or(is_dark, hn::Gt(excess_sq, hn::Set(d, 1)))) << k;
  bits.clear[window] |= BitsOf(d, hn::Or(is_dark, hn::Gt(excess_sq, hn::Set(d, limits.margin_sq))))
                        << k;
  if (window == 0) bits.dark |= BitsOf(d, below) << k;
}

template <std::size_t window>
HWY_INLINE void JudgeSize(const WindowLines& lines, int block, std::size_t k,
                          const DistortionLimits& limits, const Judgement& first,
                          const Judgement& second, std::array<Bits, 2>& bits) {
  const auto [upper, lower] =
      JoinLines<window>(lines, block, k, first.alpha_weight, second.alpha_weight);
  JudgeWindow<window>(upper, first, limits.windows[window], k, bits[0]);
  JudgeWindow<window>(lower, second, limits.windows[window], k, bits[1]);
}

HWY_INLINE Judgement JudgePixels(const DistortionRow& row, std::size_t x, std::size_t k,
                                 const DistortionLimits& limits, Bits& bits) {
  constexpr D d;
  const V alpha_shift = hn::LoadU(d, row.alpha_shift + x);
  const V alpha_weight = hn::LoadU(d, row.alpha_weight + x);
  const V cd_sq = hn::LoadU(d, row.cd_sq + x);
  const V drift = hn::LoadU(d, row.inverse_sigma + x) * hn::Set(d, limits.drift);
  const V drift_sq = drift * drift;
  const PixelLimits& alone = limits.pixel;
  const M is_dark = hn::And(hn::Lt(alpha_shift, hn::Set(d, alone.dark.shift)),
                            hn::Lt(alpha_shift * alpha_weight, hn::Set(d, alone.dark.normalized)));
  bits.clear_pixels |= BitsOf(d, hn::Or(is_dark, hn::Gt(cd_sq, hn::Set(d, alone.cd_sq) + drift_sq)))
                       << k;
  return {alpha_weight, drift_sq};
}

HWY_INLINE void SetBytes(const DecisionBytes& to, int block, const Bits& bits, unsigned judged) {
  to.clear_pixels[block] = static_cast<std::uint8_t>(bits.clear_pixels & judged);
  to.dark[block] = static_cast<std::uint8_t>(bits.dark & judged);
  for (std::size_t w = 0; w < kWindows; ++w) {
    to.doubtful[w][block] = static_cast<std::uint8_t>(bits.doubtful[w] & judged);
    to.clear[w][block] = static_cast<std::uint8_t>(bits.clear[w] & judged);
  }
}

void JudgeRun(const DistortionRowPair& pair, int begin, int end, const DistortionLimits& limits,
              const std::array<DecisionBytes, 2>& to, int rows) {
  for (int block = begin / kBlock_px; block * kBlock_px < end; ++block) {
    std::array<Bits, 2> bits;
    for (std::size_t k = 0; k < kBlock_px; k += kLanes) {
      const std::size_t x = block * kBlock_px + k;
      const Judgement first = JudgePixels(pair.rows[0], x, k, limits, bits[0]);
      const Judgement second = JudgePixels(pair.rows[1], x, k, limits, bits[1]);
      JudgeSize<0>(pair.sums, block, k, limits, first, second, bits);
      JudgeSize<1>(pair.sums, block, k, limits, first, second, bits);
    }
    const unsigned judged = 0xffu >> std::max((block + 1) * kBlock_px - end, 0);
    SetBytes(to[0], block, bits[0], judged);
    if (rows == 2) SetBytes(to[1], block, bits[1], judged);
  }
}

HWY_INLINE void StoreNormalized(const WindowDistortions& window, V weight, const WindowRow& to,
                                std::size_t x) {
  constexpr D d;
  hn::StoreU(hn::Sqrt(window.cd_sq), d, to.cd + x);
  hn::StoreU(hn::Abs(window.alpha_shift) * weight, d, to.alpha + x);
  hn::StoreU(hn::Sqrt(Larger(hn::Zero(d), window.roughness_sq)), d, to.roughness + x);
}

template <std::size_t window>
HWY_INLINE void NormalizeSize(const DistortionRowPair& pair, int blocks,
                              const std::array<WindowRow, 2>& to) {
  constexpr D d;
  for (int block = 0; block < blocks; ++block) {
    for (std::size_t k = 0; k < kBlock_px; k += kLanes) {
      const std::size_t x = block * kBlock_px + k;
      const V upper_weight = hn::LoadU(d, pair.rows[0].alpha_weight + x);
      const V lower_weight = hn::LoadU(d, pair.rows[1].alpha_weight + x);
      const auto [upper, lower] =
          JoinLines<window>(pair.sums, block, k, upper_weight, lower_weight);
      StoreNormalized(upper, upper_weight, to[0], x);
      StoreNormalized(lower, lower_weight, to[1], x);
    }
  }
}

void NormalizeBlocks(const DistortionRowPair& pair, int blocks, std::size_t window,
                     const std::array<WindowRow, 2>& to) {
  if (window == 0) NormalizeSize<0>(pair, blocks, to);
  if (window == 1) NormalizeSize<1>(pair, blocks, to);
}

void NormalizeRow(const DistortionRow& row, int count, float* cd, float* darker) {
  for (int x = 0; x < count; ++x) {
    cd[x] = std::sqrt(row.cd_sq[x]);
    darker[x] = -row.alpha_shift[x] * row.alpha_weight[x];
  }
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {
HWY_EXPORT(SumBlocks);
void SumAlongLines(const float* alpha_shift, const std::array<const float*, 3>& cd, int row_step,
                   int blocks, int rows, BlockSums* sums) {
  HWY_DYNAMIC_DISPATCH(SumBlocks)(alpha_shift, cd, row_step, blocks, rows, sums);
}
HWY_EXPORT(JudgeRun);
void JudgeWindows(const DistortionRowPair& pair, int begin, int end, const DistortionLimits& limits,
                  const std::array<DecisionBytes, 2>& to, int rows) {
  HWY_DYNAMIC_DISPATCH(JudgeRun)(pair, begin, end, limits, to, rows);
}
HWY_EXPORT(NormalizeBlocks);
void NormalizeWindows(const DistortionRowPair& pair, int blocks, std::size_t window,
                      const std::array<WindowRow, 2>& to) {
  HWY_DYNAMIC_DISPATCH(NormalizeBlocks)(pair, blocks, window, to);
}

HWY_EXPORT(NormalizeRow);
void NormalizePixels(const DistortionRow& row, int count, float* cd, float* darker) {
  HWY_DYNAMIC_DISPATCH(NormalizeRow)(row, count, cd, darker);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE

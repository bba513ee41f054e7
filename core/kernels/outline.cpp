#include "core/kernels/outline.h"

#include <bit>
#include <cstring>

#include "core/kernels/outline_reference.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/outline.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

using Decisions = std::array<OutlineDecision, kOutlineBlock_px>;

#if HWY_TARGET == HWY_SCALAR

Decisions JudgeEightPixels(const OutlineSurroundings& around, const std::array<float, 3>& gain,
                           const std::array<const WeighedPixels*, kOutlineBlock_px>& expected,
                           int first) {
  return reference::JudgeOutline(around, gain, expected, first);
}

#else

constexpr hn::FixedTag<std::uint8_t, kAround_px> kBytes;
constexpr hn::FixedTag<std::uint16_t, kAround_px / 2> kShorts;
constexpr hn::FixedTag<float, kOutlinePixels / 2> kFloats;
constexpr hn::Rebind<std::int32_t, decltype(kFloats)> kInts;
using Bytes = hn::Vec<decltype(kBytes)>;
using Shorts = hn::Vec<decltype(kShorts)>;
using Floats = hn::Vec<decltype(kFloats)>;

// The pixels around eight of a row. Words are little-endian in memory.
HWY_INLINE std::uint16_t BitsAround(const BitWord* row, int pixel) {
  static_assert(std::endian::native == std::endian::little && kOutlineBefore_px <= 8);
  // No more bytes than hold them: the last row may end there.
  constexpr std::size_t kBytesAround = (8 - kOutlineBefore_px + kAround_px + 7) / 8;
  std::uint32_t bits = 0;
  std::memcpy(&bits, reinterpret_cast<const std::uint8_t*>(row) + pixel / 8 - 1, kBytesAround);
  return static_cast<std::uint16_t>(bits >> (8 - kOutlineBefore_px));
}

template <typename D>
HWY_INLINE hn::Mask<D> MaskOf(D d, std::uint16_t bits) {
  // So many bytes may be read.
  alignas(8) std::uint8_t bytes[8] = {};
  std::memcpy(bytes, &bits, sizeof bits);
  return hn::LoadMaskBits(d, bytes);
}

// Sums each column and the one to its right.
HWY_INLINE Shorts SumPairs(Bytes columns) {
  const Shorts pairs = hn::BitCast(kShorts, columns);
  return hn::And(pairs, hn::Set(kShorts, 0xff)) + hn::ShiftRight<8>(pairs);
}

// Numbers for eight pixels.
struct Eight {
  Floats left, right;
};

// Sums the eight columns around each pixel's block, from the sums of pairs of columns.
HWY_INLINE Eight SumAround(Shorts twos) {
  const Shorts fours = twos + hn::ShiftRightBytes<2>(kShorts, twos);
  const Shorts eights = fours + hn::ShiftRightBytes<4>(kShorts, fours);
  const Shorts pixels =
      hn::InterleaveLower(kShorts, eights, hn::ShiftRightBytes<2>(kShorts, eights));
  const auto signed_pixels = hn::BitCast(hn::RebindToSigned<decltype(kShorts)>(), pixels);
  return {hn::ConvertTo(kFloats, hn::PromoteTo(kInts, hn::LowerHalf(signed_pixels))),
          hn::ConvertTo(
              kFloats,
              hn::PromoteTo(kInts, hn::UpperHalf(hn::Half<hn::RebindToSigned<decltype(kShorts)> >(),
                                                 signed_pixels)))};
}

HWY_INLINE Eight SumAround(const std::array<float, kAround_px>& columns) {
  const Floats a = hn::Load(kFloats, &columns[0]), b = hn::Load(kFloats, &columns[4]);
  const Floats c = hn::Load(kFloats, &columns[8]), d = hn::Load(kFloats, &columns[12]);
  const Floats twos = hn::ConcatEven(kFloats, b, a) + hn::ConcatOdd(kFloats, b, a);
  const Floats more_twos = hn::ConcatEven(kFloats, d, c) + hn::ConcatOdd(kFloats, d, c);
  const Floats fours = twos + hn::CombineShiftRightBytes<4>(kFloats, more_twos, twos);
  const Floats more_fours =
      more_twos + hn::CombineShiftRightBytes<4>(kFloats, more_twos, more_twos);
  const Floats eights = fours + hn::CombineShiftRightBytes<8>(kFloats, more_fours, fours);
  const Floats last = more_fours + hn::CombineShiftRightBytes<8>(kFloats, more_fours, more_fours);
  const Floats next = hn::CombineShiftRightBytes<4>(kFloats, last, eights);
  return {hn::InterleaveLower(kFloats, eights, next), hn::InterleaveUpper(kFloats, eights, next)};
}

// The person's colours and the background's brightness around pixels. NaN if there are none, so
// that nothing is decided.
struct Around {
  Floats person[3], alpha;
};
HWY_INLINE Around MeanOf(Floats blue, Floats green, Floats red, Floats inside, Floats shift,
                         Floats outside, const std::array<float, 3>& gain) {
  const Floats per_pixel = hn::Set(kFloats, 1) / inside;
  return {
      {per_pixel * blue * hn::Set(kFloats, gain[0]), per_pixel * green * hn::Set(kFloats, gain[1]),
       per_pixel * red * hn::Set(kFloats, gain[2])},
      hn::Set(kFloats, 1) + shift / outside};
}

struct AroundEight {
  Around left, right;
};
HWY_INLINE AroundEight LookAround(const OutlineSurroundings& around,
                                  const std::array<float, 3>& gain) {
  constexpr FloatsUpTo<kAround_px> d;
  const Bytes one = hn::Set(kBytes, 1);
  Shorts blue = hn::Zero(kShorts), green = blue, red = blue;
  Bytes inside = hn::Zero(kBytes), outside = inside;
  alignas(64) std::array<float, kAround_px> shifts{};
  for (const int row : kOutlineRows) {
    const auto person = BitsAround(around.inside + row * around.stride, around.pixel);
    const auto background = BitsAround(around.outside + row * around.stride, around.pixel);
    const auto is_person = MaskOf(kBytes, person);
    Bytes b, g, r;
    hn::LoadInterleaved3(kBytes, &around.image.row(kOutlineReach_px + row)->b, b, g, r);
    blue = blue + SumPairs(hn::IfThenElseZero(is_person, b));
    green = green + SumPairs(hn::IfThenElseZero(is_person, g));
    red = red + SumPairs(hn::IfThenElseZero(is_person, r));
    inside = inside + hn::IfThenElseZero(is_person, one);
    outside = outside + hn::IfThenElseZero(MaskOf(kBytes, background), one);
    const float* const shift = around.alpha_shift.row(kOutlineReach_px + row);
    for (std::size_t k = 0; k < kAround_px; k += hn::MaxLanes(d)) {
      const auto is_background = MaskOf(d, static_cast<std::uint16_t>(background >> k));
      hn::Store(
          hn::Load(d, &shifts[k]) + hn::IfThenElseZero(is_background, hn::LoadU(d, shift + k)), d,
          &shifts[k]);
    }
  }
  const Eight blues = SumAround(blue), greens = SumAround(green), reds = SumAround(red);
  const Eight insides = SumAround(SumPairs(inside)), outsides = SumAround(SumPairs(outside));
  const Eight shift = SumAround(shifts);
  return {MeanOf(blues.left, greens.left, reds.left, insides.left, shift.left, outsides.left, gain),
          MeanOf(blues.right, greens.right, reds.right, insides.right, shift.right, outsides.right,
                 gain)};
}

using Channels = std::array<std::array<std::uint8_t, kOutlinePixels>, 3>;

// Decides about four pixels of a row, from pixel `k` of the eight on.
HWY_INLINE void JudgeFour(const Around& around, const Channels& live, const WeighedPixels& expected,
                          int first, int k, const std::array<float, 3>& gain,
                          OutlineDecision& decision) {
  Floats along = hn::Zero(kFloats), contrast_sq = along;
  for (int c = 0; c < 3; ++c) {
    const Floats background = LoadAsFloats(kFloats, &expected.mean[c][first + k]) *
                              hn::Set(kFloats, WeighedPixels::kMeanUnit) * around.alpha;
    const Floats contrast = around.person[c] - background;
    along = along + contrast * (LoadAsFloats(kFloats, &live[c][k]) * hn::Set(kFloats, gain[c]) -
                                background);
    contrast_sq = contrast_sq + contrast * contrast;
  }
  const auto told = hn::Ge(contrast_sq, hn::Set(kFloats, kLeastContrast * kLeastContrast));
  const auto covered = hn::Gt(along, hn::Set(kFloats, kHalfCovered) * contrast_sq);
  decision.told |= static_cast<std::uint8_t>(BitsOf(kFloats, told) << k);
  decision.covered |= static_cast<std::uint8_t>(BitsOf(kFloats, covered) << k);
}

Decisions JudgeEightPixels(const OutlineSurroundings& around, const std::array<float, 3>& gain,
                           const std::array<const WeighedPixels*, kOutlineBlock_px>& expected,
                           int first) {
  constexpr hn::FixedTag<std::uint8_t, kOutlinePixels> d;
  const AroundEight eight = LookAround(around, gain);
  Decisions decisions{};
  for (int row = 0; row < kOutlineBlock_px; ++row) {
    const Bgr* const pixels = around.image.row(kOutlineReach_px + row) + kOutlineBefore_px;
    hn::Vec<decltype(d)> b, g, r;
    hn::LoadInterleaved3(d, &pixels->b, b, g, r);
    Channels live;
    hn::StoreU(b, d, live[0].data());
    hn::StoreU(g, d, live[1].data());
    hn::StoreU(r, d, live[2].data());
    JudgeFour(eight.left, live, *expected[row], first, 0, gain, decisions[row]);
    JudgeFour(eight.right, live, *expected[row], first, 4, gain, decisions[row]);
  }
  return decisions;
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(JudgeEightPixels);
std::array<OutlineDecision, kOutlineBlock_px> JudgeOutline(
    const OutlineSurroundings& around, const std::array<float, 3>& gain,
    const std::array<const WeighedPixels*, kOutlineBlock_px>& expected, int first) {
  return HWY_DYNAMIC_DISPATCH(JudgeEightPixels)(around, gain, expected, first);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE

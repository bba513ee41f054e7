#include "core/kernels/bits.h"

#include <algorithm>
#include <array>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/bits.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

void KeepCommonWords(const BitWord* from, std::size_t count, BitWord* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] &= from[i];
}

void AddAllWords(const BitWord* from, std::size_t count, BitWord* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] |= from[i];
}

void RemoveAllWords(const BitWord* from, std::size_t count, BitWord* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] &= ~from[i];
}

std::int64_t CountBitsOfWords(const BitWord* words, std::size_t count) {
  std::int64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) bits += std::popcount(words[i]);
  return bits;
}

// Combines each pixel with up to `radius` pixels to the left and right, by AND (`all`) or OR.
// `before` and `next` hold the neighbours of each word.
template <bool all, int radius>
HWY_INLINE void CombineBeside(const BitWord* before, const BitWord* next, std::size_t count,
                              BitWord* words) {
  for (std::size_t k = 0; k < count; ++k) {
    const BitWord here = words[k];
    BitWord result = here;
    for (int i = 1; i <= radius; ++i) {
      const BitWord left = here << i | before[k] >> (64 - i);
      const BitWord right = here >> i | next[k] << (64 - i);
      result = all ? result & left & right : result | left | right;
    }
    words[k] = result;
  }
}

// Does so in consecutive rows of `per_row` words, a few rows at a time.
template <bool all>
HWY_INLINE void CombineAlong(BitWord* words, std::size_t count, std::size_t per_row, int radius) {
  constexpr BitWord kBeyond = all ? ~BitWord{0} : 0;
  const std::size_t most = kMostRowWords / per_row * per_row;
  std::array<BitWord, kMostRowWords> before, next;
  for (std::size_t done = 0, some; done < count; done += some, words += some) {
    some = std::min(most, count - done);
    std::copy_n(words, some - 1, &before[1]);
    std::copy_n(words + 1, some - 1, &next[0]);
    for (std::size_t k = 0; k < some; k += per_row) before[k] = next[k + per_row - 1] = kBeyond;
    if (radius == 1) CombineBeside<all, 1>(before.data(), next.data(), some, words);
    if (radius == 2) CombineBeside<all, 2>(before.data(), next.data(), some, words);
    if (radius == 3) CombineBeside<all, 3>(before.data(), next.data(), some, words);
  }
}

void ErodeAlong(BitWord* words, std::size_t count, std::size_t per_row, int radius) {
  CombineAlong<true>(words, count, per_row, radius);
}

void DilateAlong(BitWord* words, std::size_t count, std::size_t per_row, int radius) {
  CombineAlong<false>(words, count, per_row, radius);
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(KeepCommonWords);
void KeepCommon(const BitWord* from, std::size_t count, BitWord* to) {
  HWY_DYNAMIC_DISPATCH(KeepCommonWords)(from, count, to);
}

HWY_EXPORT(AddAllWords);
void AddAll(const BitWord* from, std::size_t count, BitWord* to) {
  HWY_DYNAMIC_DISPATCH(AddAllWords)(from, count, to);
}

HWY_EXPORT(RemoveAllWords);
void RemoveAll(const BitWord* from, std::size_t count, BitWord* to) {
  HWY_DYNAMIC_DISPATCH(RemoveAllWords)(from, count, to);
}

HWY_EXPORT(CountBitsOfWords);
std::int64_t CountBits(const BitWord* words, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(CountBitsOfWords)(words, count);
}

HWY_EXPORT(ErodeAlong);
void KeepCommonAlong(BitWord* words, std::size_t count, std::size_t per_row, int radius) {
  HWY_DYNAMIC_DISPATCH(ErodeAlong)(words, count, per_row, radius);
}

HWY_EXPORT(DilateAlong);
void AddAllAlong(BitWord* words, std::size_t count, std::size_t per_row, int radius) {
  HWY_DYNAMIC_DISPATCH(DilateAlong)(words, count, per_row, radius);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE

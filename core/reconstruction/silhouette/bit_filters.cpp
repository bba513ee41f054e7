#include "core/reconstruction/silhouette/bit_filters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "core/errors.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

using Word = std::uint64_t;

// The bits of a row's last word that lie beyond the picture.
Word BeyondEdge(const Silhouette& s) {
  return s.width() % 64 == 0 ? 0 : ~Word{0} << s.width() % 64;
}

MOCAP_VECTORIZED
void KeepCommon(const Word* from, std::size_t count, Word* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] &= from[i];
}

MOCAP_VECTORIZED
void AddAll(const Word* from, std::size_t count, Word* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] |= from[i];
}

// Combines each pixel of a row with those `shift` to its left and right; beside the row is
// `beyond`.
template <typename Combine>
void CombineAlong(Word* row, int words, int shift, Word beyond, Combine combine) {
  Word before = beyond;
  for (int i = 0; i < words; ++i) {
    const Word here = row[i];
    const Word next = i + 1 < words ? row[i + 1] : beyond;
    row[i] = combine(here, combine(here << shift | before >> (64 - shift),
                                   here >> shift | next << (64 - shift)));
    before = here;
  }
}

// Combines each pixel with those of its square neighbourhood; `combine_words` does so with words.
template <typename Combine>
void Filter(const Silhouette& from, int radius, Word beyond, Combine combine,
            void (*combine_words)(const Word*, std::size_t, Word*), Silhouette& to) {
  MOCAP_CHECK(radius >= 1 && radius <= 3 && &from != &to);
  to = from;
  const int words = from.words_per_row();
  const auto all = from.words().size();
  for (int i = 1; i <= std::min(radius, from.height() - 1); ++i) {
    const std::size_t apart = static_cast<std::size_t>(i) * words;
    combine_words(from.row(i), all - apart, to.row(0));
    combine_words(from.row(0), all - apart, to.row(i));
  }
  const Word edge = BeyondEdge(from);
  for (int y = 0; y < from.height(); ++y) {
    Word* const row = to.row(y);
    row[words - 1] = (row[words - 1] & ~edge) | (beyond & edge);
    // Three pixels, and then three times three or so.
    CombineAlong(row, words, 1, beyond, combine);
    if (radius > 1) CombineAlong(row, words, radius - 1, beyond, combine);
    row[words - 1] &= ~edge;
  }
}

// One bit of each of sixteen bytes, counted from the lowest.
unsigned Gather(const std::uint8_t* bytes, int place) {
#ifdef __SSE2__
  const __m128i all = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
  return static_cast<unsigned>(_mm_movemask_epi8(_mm_slli_epi16(all, 7 - place)));
#else
  const auto eight = [place](const std::uint8_t* from) {
    Word word;
    std::memcpy(&word, from, 8);
    return static_cast<unsigned>((word >> place & 0x0101010101010101) * 0x0102040810204080 >> 56);
  };
  return eight(bytes) | eight(bytes + 8) << 8;
#endif
}

}  // namespace

void PackRow(std::span<const std::uint8_t> pixels, unsigned bit, int begin, Word* row) {
  MOCAP_CHECK(begin % 8 == 0 && std::has_single_bit(bit) && bit < 256);
  constexpr std::size_t kStep = 16;
  const int place = std::countr_zero(bit);
  const int shift = begin % 64;
  const std::size_t count = pixels.size();
  Word* to = row + begin / 64;
  for (std::size_t first = 0; first < count; first += 64, ++to) {
    Word word = 0;
    for (std::size_t i = 0; i < 64 && first + i < count; i += kStep) {
      const std::size_t left = count - first - i;
      Word bits;
      if (left >= kStep) {
        bits = Gather(&pixels[first + i], place);
      } else {
        std::array<std::uint8_t, kStep> rest{};
        std::copy_n(&pixels[first + i], left, rest.begin());
        bits = Gather(rest.data(), place);
      }
      word |= bits << i;
    }
    to[0] |= word << shift;
    if (shift > 0 && word >> (64 - shift) != 0) to[1] |= word >> (64 - shift);
  }
}

void Erode(const Silhouette& from, int radius, Silhouette& to) {
  Filter(
      from, radius, ~Word{0}, [](Word a, Word b) { return a & b; }, KeepCommon, to);
}

void Dilate(const Silhouette& from, int radius, Silhouette& to) {
  Filter(
      from, radius, 0, [](Word a, Word b) { return a | b; }, AddAll, to);
}

void Unite(const Silhouette& from, Silhouette& to) {
  MOCAP_CHECK(from.width() == to.width() && from.height() == to.height());
  AddAll(from.row(0), from.words().size(), to.row(0));
}

void Intersect(const Silhouette& from, Silhouette& to) {
  MOCAP_CHECK(from.width() == to.width() && from.height() == to.height());
  KeepCommon(from.row(0), from.words().size(), to.row(0));
}

void Paste(const Silhouette& from, int left, int top, Silhouette& to) {
  MOCAP_CHECK(left % 64 == 0 && left + from.width() <= to.width() &&
              top + from.height() <= to.height());
  MOCAP_CHECK(from.width() % 64 == 0 || left + from.width() == to.width());
  for (int y = 0; y < from.height(); ++y)
    std::copy_n(from.row(y), from.words_per_row(), to.row(top + y) + left / 64);
}

}  // namespace mocap

#include "core/reconstruction/silhouette/bit_filters.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "core/errors.h"

namespace mocap {
namespace {

using Word = std::uint64_t;

// The bits of a row's last word that lie beyond the picture.
Word BeyondEdge(const Silhouette& s) {
  return s.width() % 64 == 0 ? 0 : ~Word{0} << s.width() % 64;
}

bool IsEmpty(const Word* begin, const Word* end) {
  return std::all_of(begin, end, [](Word word) { return word == 0; });
}

// Combines each pixel of a row's words with those `shift` to its left and right; beside them is
// `before` and `after`.
template <typename Combine>
void CombineAlong(std::span<Word> words, int shift, Word before, Word after, Combine combine) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Word here = words[i];
    const Word next = i + 1 < words.size() ? words[i + 1] : after;
    words[i] = combine(here, combine(here << shift | before >> (64 - shift),
                                     here >> shift | next << (64 - shift)));
    before = here;
  }
}

// Most rows of most silhouettes are empty, and so is what becomes of them.
template <typename Combine>
void Filter(const Silhouette& from, int radius, Word beyond, Combine combine, Silhouette& to) {
  MOCAP_CHECK(radius >= 1 && radius <= 3 && &from != &to);
  const int words = from.words_per_row();
  const int height = from.height();
  const bool shrinks = beyond != 0;
  to.Reset(from.width(), height);
  const std::optional<PixelBox> box = from.BoundingBox();
  if (!box) return;
  const int begin = box->left / 64, end = box->right / 64 + 1;
  const int first = std::max(begin - 1, 0), last = std::min(end, words - 1);
  const Word edge = BeyondEdge(from);
  for (int y = std::max(box->top - radius, 0); y <= std::min(box->bottom + radius, height - 1);
       ++y) {
    if (shrinks && IsEmpty(from.row(y) + begin, from.row(y) + end)) continue;
    Word* const row = to.row(y);
    std::copy(from.row(y) + first, from.row(y) + last + 1, row + first);
    for (int other = y - radius; other <= y + radius; ++other) {
      if (other < 0 || other >= height || other == y) continue;
      const Word* const from_row = from.row(other);
      for (int i = begin; i < end; ++i) row[i] = combine(row[i], from_row[i]);
    }
    if (IsEmpty(row + begin, row + end)) continue;
    if (last == words - 1) row[last] = (row[last] & ~edge) | (beyond & edge);
    // Three pixels, and then three times three or so.
    const std::span<Word> span(row + first, row + last + 1);
    const Word before = first == 0 ? beyond : 0, after = last == words - 1 ? beyond : 0;
    CombineAlong(span, 1, before, after, combine);
    if (radius > 1) CombineAlong(span, radius - 1, before, after, combine);
    row[words - 1] &= ~edge;
  }
}

// Sixteen bytes of 0 or 1 as bits.
unsigned Gather(const std::uint8_t* bytes) {
#ifdef __SSE2__
  const __m128i all = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
  return static_cast<unsigned>(_mm_movemask_epi8(_mm_slli_epi16(all, 7)));
#else
  const auto eight = [](const std::uint8_t* from) {
    Word word;
    std::memcpy(&word, from, 8);
    return static_cast<unsigned>(word * 0x0102040810204080 >> 56);
  };
  return eight(bytes) | eight(bytes + 8) << 8;
#endif
}

}  // namespace

void PackRow(std::span<const std::uint8_t> pixels, int begin, Word* row) {
  MOCAP_CHECK(begin % 8 == 0);
  constexpr std::size_t kStep = 16;
  const auto add = [&](std::size_t i, Word bits) {
    const std::size_t x = begin + i;
    const std::size_t shift = x % 64;
    row[x / 64] |= bits << shift;
    if (shift > 64 - kStep && bits >> (64 - shift) != 0) row[x / 64 + 1] |= bits >> (64 - shift);
  };
  const std::size_t count = pixels.size();
  std::size_t i = 0;
  for (; i + kStep <= count; i += kStep) add(i, Gather(pixels.data() + i));
  if (i == count) return;
  std::array<std::uint8_t, kStep> rest{};
  std::copy(pixels.begin() + static_cast<std::ptrdiff_t>(i), pixels.end(), rest.begin());
  add(i, Gather(rest.data()));
}

void Erode(const Silhouette& from, int radius, Silhouette& to) {
  Filter(
      from, radius, ~Word{0}, [](Word a, Word b) { return a & b; }, to);
}

void Dilate(const Silhouette& from, int radius, Silhouette& to) {
  Filter(
      from, radius, 0, [](Word a, Word b) { return a | b; }, to);
}

void Unite(const Silhouette& from, Silhouette& to) {
  MOCAP_CHECK(from.width() == to.width() && from.height() == to.height());
  const std::size_t words = from.words().size();
  for (std::size_t i = 0; i < words; ++i) to.row(0)[i] |= from.words()[i];
}

void Intersect(const Silhouette& from, Silhouette& to) {
  MOCAP_CHECK(from.width() == to.width() && from.height() == to.height());
  const std::size_t words = from.words().size();
  for (std::size_t i = 0; i < words; ++i) to.row(0)[i] &= from.words()[i];
}

}  // namespace mocap

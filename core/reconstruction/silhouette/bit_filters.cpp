#include "core/reconstruction/silhouette/bit_filters.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/errors.h"
#include "core/lanes.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

using Word = std::uint64_t;

// The bits of a row's last word that lie beyond the picture's edge.
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

MOCAP_VECTORIZED
void RemoveAll(const Word* from, std::size_t count, Word* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] &= ~from[i];
}

// At least one row: pictures are 16384 pixels wide at most.
constexpr int kMostWords = 256;

// Combines each pixel with up to `radius` pixels to the left and right, by AND (`all`) or OR. Works
// on words; `before` and `next` hold their neighbours.
template <bool all, int radius>
MOCAP_INLINE void CombineBeside(const Word* before, const Word* next, std::size_t count,
                                Word* words) {
  for (std::size_t k = 0; k < count; ++k) {
    const Word here = words[k];
    Word result = here;
    for (int i = 1; i <= radius; ++i) {
      const Word left = here << i | before[k] >> (64 - i), right = here >> i | next[k] << (64 - i);
      result = all ? result & left & right : result | left | right;
    }
    words[k] = result;
  }
}

// Does so in consecutive rows of `per_row` words, a few rows at a time.
template <bool all>
MOCAP_INLINE void CombineAlong(Word* words, std::size_t count, std::size_t per_row, int radius) {
  constexpr Word kBeyond = all ? ~Word{0} : 0;
  const std::size_t most = kMostWords / per_row * per_row;
  std::array<Word, kMostWords> before, next;
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

MOCAP_VECTORIZED
void KeepCommonAlong(Word* words, std::size_t count, std::size_t per_row, int radius) {
  CombineAlong<true>(words, count, per_row, radius);
}

MOCAP_VECTORIZED
void AddAllAlong(Word* words, std::size_t count, std::size_t per_row, int radius) {
  CombineAlong<false>(words, count, per_row, radius);
}

// Combines each pixel with its square neighbourhood. `combine` and `combine_along` do so for words.
void Filter(const Silhouette& from, int radius, Word beyond,
            void (*combine)(const Word*, std::size_t, Word*),
            void (*combine_along)(Word*, std::size_t, std::size_t, int), Silhouette& to) {
  MOCAP_CHECK(radius >= 1 && radius <= 3 && &from != &to);
  to = from;
  const int words = from.words_per_row();
  const auto all = from.words().size();
  if (all == 0) return;
  MOCAP_CHECK(words <= kMostWords);
  for (int i = 1; i <= std::min(radius, from.height() - 1); ++i) {
    const std::size_t apart = static_cast<std::size_t>(i) * words;
    combine(from.row(i), all - apart, to.row(0));
    combine(from.row(0), all - apart, to.row(i));
  }
  const Word edge = BeyondEdge(from);
  const auto write_beyond_edge = [&](Word value) {
    for (int y = 0; edge != 0 && y < to.height(); ++y) {
      Word& last = to.row(y)[words - 1];
      last = (last & ~edge) | (value & edge);
    }
  };
  write_beyond_edge(beyond);
  combine_along(to.row(0), all, words, radius);
  write_beyond_edge(0);
}

}  // namespace

void Erode(const Silhouette& from, int radius, Silhouette& to) {
  Filter(from, radius, ~Word{0}, KeepCommon, KeepCommonAlong, to);
}

void Dilate(const Silhouette& from, int radius, Silhouette& to) {
  Filter(from, radius, 0, AddAll, AddAllAlong, to);
}

void Unite(const Silhouette& from, Silhouette& to) {
  MOCAP_CHECK(from.width() == to.width() && from.height() == to.height());
  AddAll(from.row(0), from.words().size(), to.row(0));
}

void Intersect(const Silhouette& from, Silhouette& to) {
  MOCAP_CHECK(from.width() == to.width() && from.height() == to.height());
  KeepCommon(from.row(0), from.words().size(), to.row(0));
}

void Subtract(const Silhouette& from, Silhouette& to) {
  MOCAP_CHECK(from.width() == to.width() && from.height() == to.height());
  RemoveAll(from.row(0), from.words().size(), to.row(0));
}

void Paste(const Silhouette& from, int left, int top, Silhouette& to) {
  MOCAP_CHECK(left % 64 == 0 && left + from.width() <= to.width() &&
              top + from.height() <= to.height());
  MOCAP_CHECK(from.width() % 64 == 0 || left + from.width() == to.width());
  for (int y = 0; y < from.height(); ++y)
    std::copy_n(from.row(y), from.words_per_row(), to.row(top + y) + left / 64);
}

}  // namespace mocap

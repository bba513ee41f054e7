#include "core/reconstruction/bit_filters.h"

#include <algorithm>
#include <cstring>

#include "core/errors.h"

namespace mocap {
namespace {

using Word = std::uint64_t;

// The bits of a row's last word that lie beyond the picture.
Word BeyondEdge(const Silhouette& s) {
  return s.width() % 64 == 0 ? 0 : ~Word{0} << s.width() % 64;
}

bool IsEmpty(const Word* row, int words) {
  return std::all_of(row, row + words, [](Word word) { return word == 0; });
}

// Most rows of most silhouettes are empty, and so is what becomes of them.
template <typename Combine>
void Filter(const Silhouette& from, int radius, Word beyond, Combine combine, Silhouette& to) {
  MOCAP_CHECK(radius >= 1 && radius <= 3 && &from != &to);
  const int words = from.words_per_row();
  const int height = from.height();
  const bool shrinks = beyond != 0;
  to.Reset(from.width(), height);
  if (words == 0) return;
  const Word edge = BeyondEdge(from);
  for (int y = 0; y < height; ++y) {
    if (shrinks && IsEmpty(from.row(y), words)) continue;
    Word* row = to.row(y);
    std::copy(from.row(y), from.row(y) + words, row);
    for (int other = y - radius; other <= y + radius; ++other) {
      if (other < 0 || other >= height || other == y) continue;
      const Word* from_row = from.row(other);
      for (int i = 0; i < words; ++i) row[i] = combine(row[i], from_row[i]);
    }
    if (IsEmpty(row, words)) continue;
    row[words - 1] = (row[words - 1] & ~edge) | (beyond & edge);
    // In place: `before` is the word as it was.
    Word before = beyond;
    for (int i = 0; i < words; ++i) {
      const Word here = row[i];
      const Word after = i + 1 < words ? row[i + 1] : beyond;
      Word word = here;
      for (int shift = 1; shift <= radius; ++shift) {
        word = combine(word, here << shift | before >> (64 - shift));
        word = combine(word, here >> shift | after << (64 - shift));
      }
      row[i] = word;
      before = here;
    }
    row[words - 1] &= ~edge;
  }
}

}  // namespace

void PackRow(std::span<const std::uint8_t> pixels, int begin, Word* row) {
  MOCAP_CHECK(begin % 8 == 0);
  const auto add = [&](std::size_t i, Word bytes) {
    // Eight bytes of 0 or 1 are gathered into the top byte.
    const std::size_t x = begin + i;
    row[x / 64] |= (bytes * 0x0102040810204080) >> 56 << x % 64;
  };
  const std::size_t count = pixels.size();
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    Word bytes;
    std::memcpy(&bytes, pixels.data() + i, 8);
    add(i, bytes);
  }
  if (i < count) {
    Word bytes = 0;
    std::memcpy(&bytes, pixels.data() + i, count - i);
    add(i, bytes);
  }
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

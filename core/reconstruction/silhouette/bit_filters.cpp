#include "core/reconstruction/silhouette/bit_filters.h"

#include <algorithm>
#include <cstddef>

#include "core/errors.h"
#include "core/kernels/bits.h"
#include "core/reconstruction/silhouette/pixel_run.h"

namespace mocap {
namespace {

using Word = kernels::BitWord;

// The bits of a row's last word that lie beyond the picture's edge.
Word BeyondEdge(const Silhouette& s) {
  return s.width() % 64 == 0 ? 0 : ~Word{0} << s.width() % 64;
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
  MOCAP_CHECK(static_cast<std::size_t>(words) <= kernels::kMostRowWords);
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
  Filter(from, radius, ~Word{0}, kernels::KeepCommon, kernels::KeepCommonAlong, to);
}

void Dilate(const Silhouette& from, int radius, Silhouette& to) {
  Filter(from, radius, 0, kernels::AddAll, kernels::AddAllAlong, to);
}

void Shift(const Silhouette& from, int right_px, int down_px, Silhouette& to) {
  to.Reset(from.width(), from.height());
  const int first = std::max(down_px, 0), end = std::min(from.height(), from.height() + down_px);
  for (int y = first; y < end; ++y) {
    ForEachRun(from.row(y - down_px), 0, from.width(), 0, [&](const PixelRun& run) {
      const int last = std::min(run.end + right_px, from.width());
      for (int x = std::max(run.begin + right_px, 0); x < last; ++x) to.Set(x, y);
    });
  }
  to.KeepBox();
}

void Unite(const Silhouette& from, Silhouette& to) {
  MOCAP_CHECK(from.width() == to.width() && from.height() == to.height());
  kernels::AddAll(from.row(0), from.words().size(), to.row(0));
}

void Intersect(const Silhouette& from, Silhouette& to) {
  MOCAP_CHECK(from.width() == to.width() && from.height() == to.height());
  kernels::KeepCommon(from.row(0), from.words().size(), to.row(0));
}

void Subtract(const Silhouette& from, Silhouette& to) {
  MOCAP_CHECK(from.width() == to.width() && from.height() == to.height());
  kernels::RemoveAll(from.row(0), from.words().size(), to.row(0));
}

}  // namespace mocap

#include "core/reconstruction/silhouette/silhouette_cleaner.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "core/reconstruction/silhouette/pixel_run.h"

namespace mocap {
namespace {

using Word = std::uint64_t;

// Bits [begin, end) of the word that starts at pixel 64 i.
Word MaskOf(int i, int begin, int end) {
  Word mask = ~Word{0};
  if (begin > i * 64) mask <<= begin - i * 64;
  if (end < i * 64 + 64) mask &= ~Word{0} >> (i * 64 + 64 - end);
  return mask;
}

int CountSet(const Word* row, int begin, int end) {
  int count = 0;
  for (int i = begin >> 6; i <= (end - 1) >> 6; ++i)
    count += std::popcount(row[i] & MaskOf(i, begin, end));
  return count;
}

void Flip(Word* row, int begin, int end) {
  for (int i = begin >> 6; i <= (end - 1) >> 6; ++i) row[i] ^= MaskOf(i, begin, end);
}

// A blob belongs to the person when it lies within such a share of the person's size, or is so
// large a share of the largest blob.
constexpr double kReach = 0.5;
constexpr double kLarge = 0.5;

int GapBetween(const PixelBox& a, const PixelBox& b) {
  return std::max({a.left - b.right, b.left - a.right, a.top - b.bottom, b.top - a.bottom, 0});
}

}  // namespace

void SilhouetteCleaner::DropBlobs(int smallest, Silhouette& silhouette) {
  Connect(Kind::kBlobs, nullptr, silhouette);
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i)
    if (runs_[RootOf(i)].area < smallest)
      Flip(silhouette.row(runs_[i].y), runs_[i].begin, runs_[i].end);
}

void SilhouetteCleaner::KeepPerson(int smallest, int largest_thing, Silhouette& silhouette) {
  Connect(Kind::kBlobs, nullptr, silhouette);
  if (runs_.empty()) return;
  MeasureBoxes();
  int largest = 0;
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i)
    if (runs_[RootOf(i)].area > runs_[RootOf(largest)].area) largest = i;
  largest = RootOf(largest);
  const PixelBox& person = boxes_[largest];
  const double reach =
      kReach * std::max(person.right - person.left + 1, person.bottom - person.top + 1);
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i) {
    const int root = RootOf(i);
    const int area = runs_[root].area;
    const bool is_large = area >= largest_thing || area > kLarge * runs_[largest].area;
    if (area >= smallest && (is_large || GapBetween(boxes_[root], person) <= reach)) continue;
    Flip(silhouette.row(runs_[i].y), runs_[i].begin, runs_[i].end);
  }
}

void SilhouetteCleaner::MeasureBoxes() {
  boxes_.resize(runs_.size());
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i) {
    const Run& run = runs_[i];
    const int root = RootOf(i);
    // A root comes before all others of its kind.
    if (root == i) boxes_[i] = {run.begin, run.y, run.end - 1, run.y};
    PixelBox& box = boxes_[root];
    box.left = std::min(box.left, run.begin);
    box.right = std::max(box.right, run.end - 1);
    box.bottom = run.y;
  }
}

void SilhouetteCleaner::FillHoles(int smallest, Silhouette& silhouette) {
  Connect(Kind::kHoles, nullptr, silhouette);
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i) {
    const Run& hole = runs_[RootOf(i)];
    if (!hole.at_edge && hole.area < smallest)
      Flip(silhouette.row(runs_[i].y), runs_[i].begin, runs_[i].end);
  }
}

void SilhouetteCleaner::FillHoles(int smallest, const Silhouette& doubtful,
                                  Silhouette& silhouette) {
  Connect(Kind::kHoles, &doubtful, silhouette);
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i) {
    const Run& hole = runs_[RootOf(i)];
    if (!hole.at_edge && (hole.area < smallest || 3 * hole.doubtful > 2 * hole.area))
      Flip(silhouette.row(runs_[i].y), runs_[i].begin, runs_[i].end);
  }
}

void SilhouetteCleaner::Connect(Kind kind, const Silhouette* doubtful,
                                const Silhouette& silhouette) {
  CollectRuns(kind, doubtful, silhouette);
  const int reach = kind == Kind::kBlobs ? 1 : 0;
  for (std::size_t row = 1; row + 1 < row_begins_.size(); ++row) {
    int above = row_begins_[row - 1];
    for (int here = row_begins_[row]; here < row_begins_[row + 1]; ++here) {
      while (above < row_begins_[row] && runs_[above].end + reach <= runs_[here].begin) ++above;
      for (int i = above; i < row_begins_[row] && runs_[i].begin < runs_[here].end + reach; ++i)
        Join(i, here);
    }
  }
}

// What lies beside the silhouette's box hangs together, and with what touches the box from inside:
// the box's edge is as good as the picture's.
void SilhouetteCleaner::CollectRuns(Kind kind, const Silhouette* doubtful,
                                    const Silhouette& silhouette) {
  runs_.clear();
  row_begins_.clear();
  const std::optional<PixelBox> box = silhouette.BoundingBox();
  if (!box) return;
  const int first = box->left, last = box->right + 1;
  const Word flip = kind == Kind::kBlobs ? 0 : ~Word{0};
  for (int y = box->top; y <= box->bottom; ++y) {
    row_begins_.push_back(static_cast<int>(runs_.size()));
    const Word* row = silhouette.row(y);
    ForEachRun(row, first, last, flip, [&](const PixelRun& pixels) {
      const auto [begin, end] = pixels;
      // Filled in where it stays: to copy what was only just written in parts takes long.
      Run& run = runs_.emplace_back();
      run.y = y, run.begin = begin, run.end = end;
      run.parent = static_cast<int>(runs_.size()) - 1;
      run.area = end - begin;
      run.at_edge = y == box->top || y == box->bottom || begin == first || end == last;
      if (doubtful != nullptr && !run.at_edge)
        run.doubtful = CountSet(doubtful->row(y), begin, end);
    });
  }
  row_begins_.push_back(static_cast<int>(runs_.size()));
}

int SilhouetteCleaner::RootOf(int run) {
  while (runs_[run].parent != run) {
    runs_[run].parent = runs_[runs_[run].parent].parent;
    run = runs_[run].parent;
  }
  return run;
}

void SilhouetteCleaner::Join(int a, int b) {
  a = RootOf(a);
  b = RootOf(b);
  if (a == b) return;
  if (b < a) std::swap(a, b);
  runs_[b].parent = a;
  runs_[a].area += runs_[b].area;
  runs_[a].doubtful += runs_[b].doubtful;
  runs_[a].at_edge |= runs_[b].at_edge;
}

}  // namespace mocap

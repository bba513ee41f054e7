#include "core/reconstruction/silhouette/silhouette_cleaner.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace mocap {
namespace {

using Word = std::uint64_t;

constexpr int kNone = -1, kOutside = 0;

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

// A blob belongs to the person if its distance is within this share of the person's size, or if its
// area is this share of the largest blob's.
constexpr double kReach = 0.5;
constexpr double kLarge = 0.5;

int GapBetween(const PixelBox& a, const PixelBox& b) {
  return std::max({a.left - b.right, b.left - a.right, a.top - b.bottom, b.top - a.bottom, 0});
}

}  // namespace

void SilhouetteCleaner::DropBlobs(int smallest, Silhouette& silhouette) {
  Connect(silhouette);
  KeepBlobs(smallest);
  Write(silhouette);
}

void SilhouetteCleaner::Clean(int smallest_hole, const Silhouette& doubtful, int smallest_blob,
                              Silhouette& silhouette) {
  Connect(silhouette);
  CountDoubtful(smallest_hole, doubtful);
  FillHoles([&](const Part& hole) {
    return hole.area < smallest_hole || 3 * hole.doubtful > 2 * hole.area;
  });
  KeepBlobs(smallest_blob);
  Write(silhouette);
}

void SilhouetteCleaner::KeepPerson(int smallest_hole, int smallest_blob, int largest_thing,
                                   Silhouette& silhouette) {
  Connect(silhouette);
  FillHoles([&](const Part& hole) { return hole.area < smallest_hole; });
  KeepBlobs(smallest_blob);
  DropThings(largest_thing);
  Write(silhouette);
}

// The outside surrounds the silhouette, by at least one pixel beyond the picture.
void SilhouetteCleaner::Connect(const Silhouette& silhouette) {
  const auto words = static_cast<std::size_t>(silhouette.words_per_row());
  const int right = static_cast<int>(words) * 64 + 1;
  parts_.assign(1, {kOutside, kOutside, 0, false});
  row_begins_.clear();
  int above = 0, here = CollectRuns({}, right, 0);
  for (int y = 0; y <= silhouette.height(); ++y) {
    row_begins_.push_back(here);
    std::span<const Word> row;
    if (y < silhouette.height()) row = {silhouette.row(y), words};
    const int next = CollectRuns(row, right, here);
    Run* const runs = runs_.data();
    if (next - here == here - above && GoesOn(runs + above, runs + here, next - here))
      Follow(runs + above, runs + here, next - here);
    else
      ConnectRow(runs + above, runs + here, next - here);
    above = std::exchange(here, next);
  }
  for (int i = static_cast<int>(parts_.size()) - 1; i > 0; --i)
    if (parts_[i].whole != i) parts_[parts_[i].whole].area += parts_[i].area;
}

// Lists a row's runs up to `right`, with one extra run before the first and one after the last.
// @returns the beginning of the next row's runs.
int SilhouetteCleaner::CollectRuns(std::span<const Word> row, int right, int first) {
  const auto most = static_cast<std::size_t>(first + right + 2);
  if (runs_.size() < most) runs_.resize(2 * most);
  Run* run = &runs_[first];
  *run++ = {-1, kOutside};
  Word before = 0;
  int x = 0;
  for (const Word here : row) {
    for (Word ends = here ^ (here << 1 | before >> 63); ends != 0; ends &= ends - 1)
      *run++ = {x + std::countr_zero(ends), kOutside};
    before = here;
    x += 64;
  }
  if (before >> 63 != 0) *run++ = {x, kOutside};
  *run++ = {right, kOutside};
  *run++ = {std::numeric_limits<int>::max(), kOutside};
  return static_cast<int>(run - runs_.data());
}

// Whether each run touches the run above with the same number, and no other of its kind. This holds
// for most rows, which are then processed fast.
bool SilhouetteCleaner::GoesOn(const Run* above, const Run* here, int count) {
  for (int i = 1; i < count - 2; ++i)
    if (here[i].end >= above[i + 1].end || above[i].end >= here[i + 1].end) return false;
  return true;
}

void SilhouetteCleaner::Follow(const Run* above, Run* here, int count) {
  for (int i = 2; i < count - 2; ++i) Add(here[i - 1].end, above[i].part, here[i]);
}

// Blobs also connect at corners.
void SilhouetteCleaner::ConnectRow(const Run* above, Run* here, int count) {
  int first = 1;
  for (int i = 1; i < count - 1; ++i) {
    const bool is_blob = i % 2 == 0;
    const int begin = here[i - 1].end - is_blob, end = here[i].end + is_blob;
    while (above[first].end <= begin) ++first;
    int part = i == 1 || i == count - 2 ? kOutside : kNone;
    for (int k = first + (first + i) % 2; above[k - 1].end < end; k += 2)
      part = part == kNone ? above[k].part : Join(part, above[k].part);
    if (part == kNone) {
      part = static_cast<int>(parts_.size());
      parts_.push_back({part, here[i - 1].part, 0, is_blob});
    }
    Add(here[i - 1].end, part, here[i]);
  }
}

void SilhouetteCleaner::Add(int begin, int part, Run& run) {
  run.part = part;
  parts_[part].area += run.end - begin;
}

int SilhouetteCleaner::WholeOf(int part) {
  while (parts_[part].whole != part) {
    parts_[part].whole = parts_[parts_[part].whole].whole;
    part = parts_[part].whole;
  }
  return part;
}

int SilhouetteCleaner::Join(int a, int b) {
  if (a == b) return a;
  a = WholeOf(a);
  b = WholeOf(b);
  if (b < a) std::swap(a, b);
  return parts_[b].whole = a;
}

// Calls `visit` with the row, both ends and the part of each run that is not outside.
template <typename Visit>
void SilhouetteCleaner::ForEachRun(Visit visit) {
  for (int y = 0; y + 1 < static_cast<int>(row_begins_.size()); ++y)
    for (int i = row_begins_[y] + 2; i < row_begins_[y + 1] - 2; ++i)
      visit(y, runs_[i - 1].end, runs_[i].end, runs_[i].part);
}

void SilhouetteCleaner::CountDoubtful(int smallest, const Silhouette& doubtful) {
  const auto is_asked = [&](int part) {
    return part != kOutside && !parts_[part].is_blob && parts_[part].area >= smallest;
  };
  bool any = false;
  for (int i = 1; i < static_cast<int>(parts_.size()); ++i)
    any |= parts_[i].whole == i && is_asked(i);
  if (!any) return;  // The usual case.
  ForEachRun([&](int y, int begin, int end, int part) {
    const int hole = WholeOf(part);
    if (is_asked(hole)) parts_[hole].doubtful += CountSet(doubtful.row(y), begin, end);
  });
}

// Blobs within a filled hole, and everything they are filled with, come after it.
template <typename IsFilled>
void SilhouetteCleaner::FillHoles(IsFilled is_filled) {
  for (int i = 1; i < static_cast<int>(parts_.size()); ++i) {
    if (parts_[i].whole != i) continue;
    const int around = WholeOf(parts_[i].around);
    if (parts_[i].is_blob ? !parts_[around].is_blob : !is_filled(parts_[i])) continue;
    parts_[i].whole = around;
    parts_[around].area += parts_[i].area;
  }
}

void SilhouetteCleaner::KeepBlobs(int smallest) {
  for (Part& part : parts_) part.is_set = part.is_blob && part.area >= smallest;
}

void SilhouetteCleaner::DropThings(int largest_thing) {
  int largest = kOutside, blobs = 0;
  for (int i = 1; i < static_cast<int>(parts_.size()); ++i) {
    if (parts_[i].whole != i || !parts_[i].is_set) continue;
    if (++blobs == 1 || parts_[i].area > parts_[largest].area) largest = i;
  }
  if (blobs < 2) return;
  MeasureBoxes();
  const PixelBox& person = boxes_[largest];
  const double reach =
      kReach * std::max(person.right - person.left + 1, person.bottom - person.top + 1);
  for (int i = 1; i < static_cast<int>(parts_.size()); ++i) {
    const int area = parts_[i].area;
    const bool is_large = area >= largest_thing || area > kLarge * parts_[largest].area;
    if (!is_large && GapBetween(boxes_[i], person) > reach) parts_[i].is_set = false;
  }
}

void SilhouetteCleaner::MeasureBoxes() {
  constexpr int kFar = std::numeric_limits<int>::max() / 2;
  boxes_.assign(parts_.size(), {kFar, kFar, -kFar, -kFar});
  ForEachRun([&](int y, int begin, int end, int part) {
    PixelBox& box = boxes_[WholeOf(part)];
    box = {std::min(box.left, begin), std::min(box.top, y), std::max(box.right, end - 1), y};
  });
}

void SilhouetteCleaner::Write(Silhouette& silhouette) {
  bool changes = false;
  for (Part& part : parts_) {
    part.is_set = parts_[part.whole].is_set;
    changes |= part.is_set != part.is_blob;
  }
  if (!changes) return;
  ForEachRun([&](int y, int begin, int end, int i) {
    if (parts_[i].is_set != parts_[i].is_blob) Flip(silhouette.row(y), begin, end);
  });
}

}  // namespace mocap

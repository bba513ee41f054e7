#include "core/reconstruction/silhouette/silhouette_cleaner.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/reconstruction/silhouette/pixel_run.h"
#include "core/reconstruction/silhouette/segmentation_constants.h"

namespace mocap {
namespace {

using namespace segmentation;

constexpr int kNone = -1, kOutside = 0;

int CountSet(const std::uint64_t* row, int begin, int end) {
  int count = 0;
  ForEachRun(row, begin, end, 0, [&](const PixelRun& run) { count += run.end - run.begin; });
  return count;
}

int GapBetween(const PixelBox& a, const PixelBox& b) {
  return std::max({a.left - b.right, b.left - a.right, a.top - b.bottom, b.top - a.bottom, 0});
}

}  // namespace

void SilhouetteCleaner::DropBlobs(int smallest, Silhouette& silhouette) {
  FindParts(silhouette, nullptr);
  KeepBlobs(smallest);
  Write(silhouette);
}

void SilhouetteCleaner::FillHoles(Silhouette& silhouette) {
  FindParts(silhouette, nullptr);
  FillHolesIf([](const Part&) { return true; });
  KeepBlobs(0);
  Write(silhouette);
}

void SilhouetteCleaner::Clean(int smallest_hole, const Silhouette& doubtful, int smallest_blob,
                              Silhouette& silhouette) {
  FindParts(silhouette, &doubtful);
  FillHolesIf([&](const Part& hole) {
    return hole.area < smallest_hole || 3 * hole.doubtful > 2 * hole.area;
  });
  KeepBlobs(smallest_blob);
  Write(silhouette);
}

void SilhouetteCleaner::KeepPerson(int smallest_hole, int smallest_blob, int largest_thing,
                                   Silhouette& silhouette) {
  FindParts(silhouette, nullptr);
  FillHolesIf([&](const Part& hole) { return hole.area < smallest_hole; });
  KeepBlobs(smallest_blob);
  DropThings(largest_thing);
  Write(silhouette);
}

// Everything around the silhouette's box is outside.
void SilhouetteCleaner::FindParts(const Silhouette& silhouette, const Silhouette* doubtful) {
  runs_.clear();
  parts_.assign(1, {kOutside, kOutside, false});
  const auto box = silhouette.BoundingBox();
  if (!box) return;
  std::size_t above = 0;
  for (int y = box->top; y <= box->bottom; ++y) {
    const std::uint64_t* const row = silhouette.row(y);
    const bool is_at_edge = y == box->top || y == box->bottom;
    const std::size_t first = runs_.size();
    bool is_blob = silhouette.Test(box->left, y);
    for (int x = box->left; x <= box->right; is_blob = !is_blob) {
      Run run{y, x, FindPixel(row, x, box->right + 1, is_blob ? ~std::uint64_t{0} : 0), kNone};
      while (above < first && runs_[above].end < run.begin) ++above;
      run.part =
          PartOf(run, is_blob, is_at_edge || x == box->left || run.end > box->right, above, first);
      runs_.push_back(run);
      x = run.end;
    }
    above = first;
  }
  for (const Run& run : runs_) {
    Part& part = parts_[WholeOf(run.part)];
    part.area += run.end - run.begin;
    part.box = {std::min(part.box.left, run.begin), std::min(part.box.top, run.y),
                std::max(part.box.right, run.end - 1), run.y};
    if (doubtful != nullptr && !part.is_blob && run.part != kOutside)
      part.doubtful += CountSet(doubtful->row(run.y), run.begin, run.end);
  }
}

// Connects a run with those of its kind in the row above, which begin at `above` and end at `row`.
// Blobs also connect at corners.
int SilhouetteCleaner::PartOf(const Run& run, bool is_blob, bool is_outside, std::size_t above,
                              std::size_t row) {
  int part = is_outside && !is_blob ? kOutside : kNone;
  for (; above < row && runs_[above].begin < run.end + is_blob; ++above) {
    const int other = runs_[above].part;
    if (runs_[above].end + is_blob <= run.begin || parts_[other].is_blob != is_blob) continue;
    part = part == kNone ? other : Join(part, other);
  }
  if (part != kNone) return part;
  part = static_cast<int>(parts_.size());
  const int around = runs_.size() > row ? runs_.back().part : kOutside;
  parts_.push_back({part, around, is_blob});
  return part;
}

int SilhouetteCleaner::WholeOf(int part) {
  while (parts_[part].whole != part) part = parts_[part].whole = parts_[parts_[part].whole].whole;
  return part;
}

int SilhouetteCleaner::Join(int a, int b) {
  a = WholeOf(a);
  b = WholeOf(b);
  return parts_[std::max(a, b)].whole = std::min(a, b);
}

// Blobs within a filled hole, and everything they are filled with, come after it.
template <typename IsFilled>
void SilhouetteCleaner::FillHolesIf(IsFilled is_filled) {
  for (int i = 1; i < static_cast<int>(parts_.size()); ++i) {
    if (parts_[i].whole != i) continue;
    const int around = WholeOf(parts_[i].around);
    if (parts_[i].is_blob ? !parts_[around].is_blob : !is_filled(parts_[i])) continue;
    parts_[i].whole = around;
    parts_[around].area += parts_[i].area;
  }
}

void SilhouetteCleaner::KeepBlobs(int smallest) {
  for (int i = 0; i < static_cast<int>(parts_.size()); ++i)
    parts_[i].is_set = parts_[i].whole == i && parts_[i].is_blob && parts_[i].area >= smallest;
}

void SilhouetteCleaner::DropThings(int largest_thing) {
  const Part& person = *std::ranges::max_element(
      parts_, {}, [](const Part& part) { return part.is_set ? part.area : 0; });
  if (!person.is_set) return;
  const PixelBox box = person.box;
  const double thing = std::min<double>(largest_thing - 1, kLarge * person.area);
  const double reach = kReach * std::max(box.right - box.left + 1, box.bottom - box.top + 1);
  for (Part& part : parts_)
    if (part.area <= thing && GapBetween(part.box, box) > reach) part.is_set = false;
}

void SilhouetteCleaner::Write(Silhouette& silhouette) {
  for (const Run& run : runs_) {
    if (parts_[WholeOf(run.part)].is_set == parts_[run.part].is_blob) continue;
    std::uint64_t* const row = silhouette.row(run.y);
    for (int x = run.begin; x < run.end; ++x) row[x >> 6] ^= std::uint64_t{1} << (x & 63);
  }
}

}  // namespace mocap

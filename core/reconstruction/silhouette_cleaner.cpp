#include "core/reconstruction/silhouette_cleaner.h"

#include <algorithm>
#include <limits>

namespace mocap {

void SilhouetteCleaner::Clean(Silhouette& silhouette) {
  const int smallest = static_cast<int>(smallest_share_ * silhouette.width() * silhouette.height());
  RemoveSmall(Kind::kHoles, smallest / 2, silhouette);
  RemoveSmall(Kind::kBlobs, smallest, silhouette);
}

void SilhouetteCleaner::CollectRuns(Kind kind, const Silhouette& silhouette) {
  runs_.clear();
  row_begins_.clear();
  for (int y = 0; y < silhouette.height(); ++y) {
    row_begins_.push_back(static_cast<int>(runs_.size()));
    int begin = -1;
    for (int x = 0; x <= silhouette.width(); ++x) {
      const bool in = x < silhouette.width() && silhouette.Test(x, y) == (kind == Kind::kBlobs);
      if (in && begin < 0) begin = x;
      if (!in && begin >= 0) {
        // What touches the picture's edge is no hole.
        const bool open = kind == Kind::kHoles && (y == 0 || y == silhouette.height() - 1 ||
                                                   begin == 0 || x == silhouette.width());
        const int area = open ? std::numeric_limits<int>::max() / 2 : x - begin;
        runs_.push_back({y, begin, x, static_cast<int>(runs_.size()), area});
        begin = -1;
      }
    }
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
  runs_[a].area = std::min(runs_[a].area + runs_[b].area, std::numeric_limits<int>::max() / 2);
}

void SilhouetteCleaner::RemoveSmall(Kind kind, int smallest, Silhouette& silhouette) {
  CollectRuns(kind, silhouette);
  // Blobs hang together over corners, and so holes do not.
  const int reach = kind == Kind::kBlobs ? 1 : 0;
  for (int y = 1; y < silhouette.height(); ++y) {
    int above = row_begins_[y - 1];
    for (int here = row_begins_[y]; here < row_begins_[y + 1]; ++here) {
      while (above < row_begins_[y] && runs_[above].end + reach <= runs_[here].begin) ++above;
      for (int i = above; i < row_begins_[y] && runs_[i].begin < runs_[here].end + reach; ++i)
        Join(i, here);
    }
  }
  for (int i = 0; i < static_cast<int>(runs_.size()); ++i) {
    if (runs_[RootOf(i)].area >= smallest) continue;
    for (int x = runs_[i].begin; x < runs_[i].end; ++x)
      silhouette.row(runs_[i].y)[x >> 6] ^= std::uint64_t{1} << (x & 63);
  }
}

}  // namespace mocap

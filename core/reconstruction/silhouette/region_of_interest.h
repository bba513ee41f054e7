// §4: the parts of a picture that are segmented at full resolution.
#pragma once

#include <algorithm>

#include "core/reconstruction/background/half_picture.h"
#include "core/reconstruction/silhouette/bit_filters.h"
#include "core/reconstruction/silhouette/pixel_run.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Whole tiles of a picture, with the surroundings that their decisions need. Reuses its memory.
class RegionOfInterest {
 public:
  static constexpr int kTile_px = HalfPicture::kTile_px;

  /// Sets the suspicious tiles and their neighbours.
  /// @param suspicious     one pixel per tile of kTile_px pixels.
  /// @param width, height  of the picture.
  void Set(const Silhouette& suspicious, int width, int height) {
    width_ = width;
    height_ = height;
    Dilate(suspicious, 1, judged_);
    Dilate(judged_, 1, measured_);
  }
  /// Sets the whole picture.
  void SetAll(int width, int height) {
    Silhouette all((width + kTile_px - 1) / kTile_px, (height + kTile_px - 1) / kTile_px);
    for (int y = 0; y < all.height(); ++y)
      for (int x = 0; x < all.width(); ++x) all.Set(x, y);
    Set(all, width, height);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  /// Calls `visit` for the runs of judged pixels in a row, from left to right. All rows of a tile
  /// have the same.
  template <typename Visit>
  void ForEachJudged(int y, Visit visit) const {
    VisitRuns(judged_, y, visit);
  }
  /// Does so for the measured pixels: the judged ones, and a tile more in every direction.
  template <typename Visit>
  void ForEachMeasured(int y, Visit visit) const {
    VisitRuns(measured_, y, visit);
  }

 private:
  template <typename Visit>
  void VisitRuns(const Silhouette& tiles, int y, Visit visit) const {
    ForEachRun(tiles.row(y / kTile_px), 0, tiles.width(), 0, [&](const PixelRun& run) {
      visit(PixelRun{run.begin * kTile_px, std::min(run.end * kTile_px, width_)});
    });
  }

  int width_ = 0, height_ = 0;
  Silhouette judged_, measured_;
};

}  // namespace mocap

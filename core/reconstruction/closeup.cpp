#include "core/reconstruction/closeup.h"

#include <algorithm>

#include "core/reconstruction/bit_filters.h"

namespace mocap {
namespace {

constexpr int kTile_px = HalfPicture::kTile_px;

}  // namespace

void Closeup::Set(const Silhouette& suspicious, int width, int height) {
  width_ = width;
  height_ = height;
  Dilate(suspicious, 1, tiles_);
  Dilate(tiles_, 1, wider_);
  judged_.Set(tiles_, width);
  measured_.Set(wider_, width);
}

void Closeup::SetAll(int width, int height) {
  Silhouette all((width + kTile_px - 1) / kTile_px, (height + kTile_px - 1) / kTile_px);
  for (int y = 0; y < all.height(); ++y)
    for (int x = 0; x < all.width(); ++x) all.Set(x, y);
  Set(all, width, height);
}

void Closeup::Runs::Set(const Silhouette& tiles, int width) {
  runs_.clear();
  begins_.clear();
  for (int row = 0; row < tiles.height(); ++row) {
    begins_.push_back(static_cast<int>(runs_.size()));
    for (int column = 0; column < tiles.width(); ++column) {
      if (!tiles.Test(column, row)) continue;
      const int begin = column * kTile_px;
      const int end = std::min(begin + kTile_px, width);
      if (static_cast<int>(runs_.size()) > begins_.back() && runs_.back().end == begin)
        runs_.back().end = end;
      else
        runs_.push_back({begin, end});
    }
  }
  begins_.push_back(static_cast<int>(runs_.size()));
}

}  // namespace mocap

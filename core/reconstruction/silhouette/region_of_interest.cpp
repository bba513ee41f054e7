#include "core/reconstruction/silhouette/region_of_interest.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {
namespace {

constexpr int kTile_px = HalfPicture::kTile_px;

}  // namespace

void RegionOfInterest::Set(const Silhouette& suspicious, int width, int height) {
  width_ = width;
  height_ = height;
  Dilate(suspicious, 1, tiles_);
  const int rows = tiles_.height(), words = tiles_.words_per_row();
  judged_.Clear(kTile_px);
  for (int row = 0; row < rows; ++row)
    judged_.AddRow(words, width, 0, [tiles = tiles_.row(row)](int i) { return tiles[i]; });
  // Each half of a tile is close to the tile above or below.
  measured_.Clear(kMargin_px);
  for (int half = 0; half < 2 * rows; ++half) {
    const int row = half / 2;
    const int near = std::clamp(row + (half % 2 == 0 ? -1 : 1), 0, rows - 1);
    measured_.AddRow(words, width, kMargin_px,
                     [tiles = tiles_.row(row), beside = tiles_.row(near)](int i) {
                       return tiles[i] | beside[i];
                     });
  }
  MeasureFrame();
}

void RegionOfInterest::MeasureFrame() {
  constexpr int kWord_px = 64;
  // The margin that is scanned around a silhouette is wider than the measured one.
  constexpr int kBeside_px = kTile_px;
  const PixelBox tiles = tiles_.BoundingBox().value_or(PixelBox{});
  frame_.left = std::max(tiles.left * kTile_px - kBeside_px, 0) / kWord_px * kWord_px;
  frame_.top = std::max(tiles.top * kTile_px - kBeside_px, 0);
  const int right = (tiles.right + 1) * kTile_px + kBeside_px;
  frame_.right = std::min((right + kWord_px - 1) / kWord_px * kWord_px, width_) - 1;
  frame_.bottom = std::min((tiles.bottom + 1) * kTile_px + kBeside_px, height_) - 1;
}

void RegionOfInterest::SetAll(int width, int height) {
  Silhouette all((width + kTile_px - 1) / kTile_px, (height + kTile_px - 1) / kTile_px);
  for (int y = 0; y < all.height(); ++y)
    for (int x = 0; x < all.width(); ++x) all.Set(x, y);
  Set(all, width, height);
}

void RegionOfInterest::Runs::Clear(int row_px) {
  row_px_ = row_px;
  runs_.clear();
  begins_.assign(1, 0);
}

template <typename WordAt>
void RegionOfInterest::Runs::AddRow(int words, int width, int margin_px, WordAt word_at) {
  const int first = begins_.back();
  for (int i = 0; i < words; ++i) {
    for (std::uint64_t tiles = word_at(i); tiles != 0;) {
      const int column = std::countr_zero(tiles);
      const int columns = std::countr_one(tiles >> column);
      tiles &= column + columns < 64 ? ~std::uint64_t{0} << (column + columns) : 0;
      const int begin = std::max((i * 64 + column) * kTile_px - margin_px, 0);
      const int end = std::min((i * 64 + column + columns) * kTile_px + margin_px, width);
      if (static_cast<int>(runs_.size()) > first && runs_.back().end >= begin)
        runs_.back().end = end;
      else
        runs_.push_back({begin, end});
    }
  }
  begins_.push_back(static_cast<int>(runs_.size()));
}

}  // namespace mocap

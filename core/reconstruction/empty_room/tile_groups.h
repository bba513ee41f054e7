// Connected parts of a picture, found by its tiles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// A picture in square tiles.
struct TileGrid {
  static constexpr int kTile_px = 8;

  TileGrid(int picture_width, int picture_height)
      : width(picture_width),
        height(picture_height),
        columns((width + kTile_px - 1) / kTile_px),
        rows((height + kTile_px - 1) / kTile_px) {}

  std::size_t size() const { return static_cast<std::size_t>(columns) * rows; }
  std::size_t TileAt(int x, int y) const {
    return static_cast<std::size_t>(y / kTile_px) * columns + x / kTile_px;
  }

  int width, height, columns, rows;
};

/// Visits adjacent tiles, also at corners, and the tile itself.
template <typename Visit>
void ForEachTileAround(const TileGrid& grid, std::size_t tile, const Visit& visit) {
  const int column = static_cast<int>(tile) % grid.columns;
  const int row = static_cast<int>(tile) / grid.columns;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, grid.rows - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, grid.columns - 1); ++x)
      visit(static_cast<std::size_t>(y) * grid.columns + x);
  }
}

/// Adjacent tiles.
struct TileGroup {
  std::vector<std::size_t> tiles;
  PixelBox box;     ///< Around the tiles.
  int area_px = 0;  ///< Counted pixels.
};

/// Groups tiles that touch, also at corners, the largest group first.
/// @param pixels  counted in each tile; those without any are in no group.
std::vector<TileGroup> GroupTiles(const TileGrid& grid, std::vector<int> pixels);

}  // namespace mocap

#include "core/reconstruction/empty_room/tile_groups.h"

#include <algorithm>
#include <functional>

namespace mocap {
namespace {

/// Takes a tile's group out of `pixels`.
TileGroup GroupAt(const TileGrid& grid, std::size_t first, std::vector<int>& pixels) {
  constexpr int kTile = TileGrid::kTile_px;
  TileGroup group;
  int left = grid.columns, top = grid.rows, right = 0, bottom = 0;
  const auto take = [&](std::size_t tile) {
    if (pixels[tile] == 0) return;
    group.area_px += pixels[tile];
    pixels[tile] = 0;
    group.tiles.push_back(tile);
    const int column = static_cast<int>(tile) % grid.columns;
    const int row = static_cast<int>(tile) / grid.columns;
    left = std::min(left, column), right = std::max(right, column);
    top = std::min(top, row), bottom = std::max(bottom, row);
  };
  take(first);
  for (std::size_t i = 0; i < group.tiles.size(); ++i)
    ForEachTileAround(grid, group.tiles[i], take);
  group.box = {left * kTile, top * kTile, std::min((right + 1) * kTile, grid.width) - 1,
               std::min((bottom + 1) * kTile, grid.height) - 1};
  return group;
}

}  // namespace

std::vector<TileGroup> GroupTiles(const TileGrid& grid, std::vector<int> pixels) {
  std::vector<TileGroup> groups;
  for (std::size_t tile = 0; tile < pixels.size(); ++tile) {
    if (pixels[tile] != 0) groups.push_back(GroupAt(grid, tile, pixels));
  }
  std::ranges::stable_sort(groups, std::greater(), &TileGroup::area_px);
  return groups;
}

}  // namespace mocap

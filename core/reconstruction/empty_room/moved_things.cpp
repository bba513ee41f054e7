#include "core/reconstruction/empty_room/moved_things.h"

#include <algorithm>

namespace mocap {
namespace {

using Place = EmptyRoom::Place;

/// The picture in tiles.
struct TileGrid {
  explicit TileGrid(const EmptyRoom& room)
      : width(room.color.width()),
        height(room.color.height()),
        columns((width + MovedThing::kTile_px - 1) / MovedThing::kTile_px),
        rows((height + MovedThing::kTile_px - 1) / MovedThing::kTile_px) {}

  /// The pixels of some tiles.
  PixelBox Pixels(int left, int top, int right, int bottom) const {
    constexpr int kTile = MovedThing::kTile_px;
    return {left * kTile, top * kTile, std::min((right + 1) * kTile, width) - 1,
            std::min((bottom + 1) * kTile, height) - 1};
  }

  int width, height, columns, rows;
};

/// Adjacent tiles, and itself.
template <typename Visit>
void ForEachAround(const TileGrid& grid, std::size_t tile, Visit visit) {
  const int column = static_cast<int>(tile) % grid.columns;
  const int row = static_cast<int>(tile) / grid.columns;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, grid.rows - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, grid.columns - 1); ++x)
      visit(static_cast<std::size_t>(y) * grid.columns + x);
  }
}

/// Moved pixels of each tile; 0 where these are less than half of what was seen.
std::vector<int> MovedPixels(const EmptyRoom& room, const TileGrid& grid) {
  const std::size_t tiles = static_cast<std::size_t>(grid.columns) * grid.rows;
  std::vector<int> moved(tiles), seen(tiles);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Place place = room.places[static_cast<std::size_t>(y) * grid.width + x];
      const std::size_t tile = static_cast<std::size_t>(y / MovedThing::kTile_px) * grid.columns +
                               x / MovedThing::kTile_px;
      moved[tile] += place == Place::kMoved;
      seen[tile] += place != Place::kUnseen;
    }
  }
  for (std::size_t i = 0; i < tiles; ++i) {
    if (2 * moved[i] < seen[i]) moved[i] = 0;
  }
  return moved;
}

/// Takes a tile's thing out of `moved`.
MovedThing ThingAt(const TileGrid& grid, std::size_t first, std::vector<int>& moved) {
  MovedThing thing;
  std::vector<std::size_t> tiles;
  int left = grid.columns, top = grid.rows, right = 0, bottom = 0;
  const auto take = [&](std::size_t tile) {
    if (moved[tile] == 0) return;
    thing.area_px += moved[tile];
    moved[tile] = 0;
    tiles.push_back(tile);
    const int column = static_cast<int>(tile) % grid.columns;
    const int row = static_cast<int>(tile) / grid.columns;
    left = std::min(left, column), right = std::max(right, column);
    top = std::min(top, row), bottom = std::max(bottom, row);
  };
  take(first);
  for (std::size_t i = 0; i < tiles.size(); ++i) ForEachAround(grid, tiles[i], take);
  thing.box = grid.Pixels(left, top, right, bottom);
  return thing;
}

}  // namespace

std::vector<MovedThing> FindMoved(const EmptyRoom& room, int smallest_px) {
  const TileGrid grid(room);
  std::vector<int> moved = MovedPixels(room, grid);
  std::vector<MovedThing> things;
  for (std::size_t tile = 0; tile < moved.size(); ++tile) {
    if (moved[tile] == 0) continue;
    const MovedThing thing = ThingAt(grid, tile, moved);
    if (thing.area_px >= smallest_px) things.push_back(thing);
  }
  std::ranges::stable_sort(things, std::greater(), &MovedThing::area_px);
  return things;
}

}  // namespace mocap

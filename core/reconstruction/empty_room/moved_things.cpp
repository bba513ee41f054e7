#include "core/reconstruction/empty_room/moved_things.h"

#include "core/reconstruction/empty_room/tile_groups.h"

namespace mocap {
namespace {

using Place = EmptyRoom::Place;

/// Moved pixels of each tile; 0 where these are less than half of what was seen.
std::vector<int> MovedPixels(const EmptyRoom& room, const TileGrid& grid) {
  std::vector<int> moved(grid.size()), seen(grid.size());
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Place place = room.places[static_cast<std::size_t>(y) * grid.width + x];
      moved[grid.TileAt(x, y)] += place == Place::kMoved;
      seen[grid.TileAt(x, y)] += place != Place::kUnseen;
    }
  }
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (2 * moved[i] < seen[i]) moved[i] = 0;
  }
  return moved;
}

}  // namespace

std::vector<MovedThing> FindMoved(const EmptyRoom& room, int smallest_px) {
  const TileGrid grid(room.color.width(), room.color.height());
  std::vector<MovedThing> things;
  for (const TileGroup& group : GroupTiles(grid, MovedPixels(room, grid))) {
    if (group.area_px >= smallest_px) things.push_back({group.box, group.area_px});
  }
  return things;
}

}  // namespace mocap

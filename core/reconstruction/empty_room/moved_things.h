// Beyond the paper: furniture that was moved since the empty studio was seen last.
#pragma once

#include <vector>

#include "core/reconstruction/empty_room/empty_room.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Part of a picture where the empty studio changed.
struct MovedThing {
  PixelBox box;  ///< Of whole tiles.
  int area_px = 0;
};

/// Finds connected parts of the picture that moved, the largest first.
/// @param smallest_px  smaller ones are left out.
std::vector<MovedThing> FindMoved(const EmptyRoom& room, int smallest_px);

}  // namespace mocap

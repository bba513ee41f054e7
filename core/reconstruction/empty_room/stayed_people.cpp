#include "core/reconstruction/empty_room/stayed_people.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/reconstruction/empty_room/steady_picture.h"
#include "core/reconstruction/empty_room/tile_groups.h"

namespace mocap {
namespace {

using Place = EmptyRoom::Place;

/// Feet are this far below what sways [share of the height].
constexpr double kFeetShare = 0.1;

/// A place in a row: the leftmost pixel, or the rightmost as a negative number.
struct RowEnd {
  int y, x;
};

/// Whether the second of three ends is not left of the line between the others.
bool IsWithin(const RowEnd& a, const RowEnd& b, const RowEnd& c) {
  return static_cast<long>(b.x - a.x) * (c.y - a.y) >= static_cast<long>(c.x - a.x) * (b.y - a.y);
}

/// The left side of the convex hull of ends, which have increasing rows.
std::vector<RowEnd> LeftSide(const std::vector<RowEnd>& ends) {
  std::vector<RowEnd> side;
  for (const RowEnd& end : ends) {
    while (side.size() > 1 && IsWithin(side[side.size() - 2], side.back(), end)) side.pop_back();
    side.push_back(end);
  }
  return side;
}

/// Where a side is in a row between its first and its last.
int SideAt(const std::vector<RowEnd>& side, int y) {
  std::size_t next = 0;
  while (side[next].y < y) ++next;
  const RowEnd& to = side[next];
  if (to.y == y) return to.x;
  const RowEnd& from = side[next - 1];
  return static_cast<int>(
      std::floor(from.x + static_cast<double>(to.x - from.x) * (y - from.y) / (to.y - from.y)));
}

/// The convex hull of pixels and of the same pixels further down.
class BodyHull {
 public:
  explicit BodyHull(int height) : left_(height, kNone), right_(height, kNone) {}

  /// Adds a pixel, and those whose means have a part of it.
  void Add(int x, int y) {
    const int last = std::min(y + kSmoothed_px, static_cast<int>(left_.size()) - 1);
    for (int row = std::max(y - kSmoothed_px, 0); row <= last; ++row) {
      left_[row] = std::min(left_[row], std::max(x - kSmoothed_px, 0));
      right_[row] = std::min(right_[row], -x - kSmoothed_px);
    }
  }

  template <typename Visit>
  void ForEachPixel(int width, const Visit& visit) {
    const auto is_set = [](int x) { return x != kNone; };
    const int top = static_cast<int>(std::ranges::find_if(left_, is_set) - left_.begin());
    int bottom = static_cast<int>(left_.size()) - 1;
    while (!is_set(left_[bottom])) --bottom;
    const int down = static_cast<int>(std::lround(kFeetShare * (bottom - top + 1)));
    const std::vector<RowEnd> left = LeftSide(Ends(left_, down)),
                              right = LeftSide(Ends(right_, down));
    for (int y = top; y <= left.back().y; ++y) {
      for (int x = SideAt(left, y); x <= std::min(-SideAt(right, y), width - 1); ++x) visit(x, y);
    }
  }

 private:
  static constexpr int kNone = 1 << 20;

  /// The ends of rows, and of those that are `down` rows below them.
  static std::vector<RowEnd> Ends(const std::vector<int>& of, int down) {
    std::vector<RowEnd> ends;
    for (int y = 0; y < static_cast<int>(of.size()); ++y) {
      const int x = std::min(of[y], y >= down ? of[y - down] : kNone);
      if (x != kNone) ends.push_back({y, x});
    }
    return ends;
  }

  std::vector<int> left_, right_;
};

}  // namespace

void HideStayedPeople(const EarlierRoom* earlier, int smallest_px, EmptyRoom& room) {
  const TileGrid grid(room.color.width(), room.color.height());
  const auto place_at = [&](int x, int y) -> Place& {
    return room.places[static_cast<std::size_t>(y) * grid.width + x];
  };
  const auto is_open = [&](int x, int y) { return !earlier || !earlier->Knows(x, y); };
  std::vector<int> unseen(grid.size());
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x)
      unseen[grid.TileAt(x, y)] += place_at(x, y) == Place::kUnseen && is_open(x, y);
  }
  std::vector<BodyHull> hulls;
  for (const TileGroup& group : GroupTiles(grid, unseen)) {
    if (group.area_px < smallest_px) break;
    BodyHull& hull = hulls.emplace_back(grid.height);
    for (const std::size_t tile : group.tiles) {
      const int left = static_cast<int>(tile) % grid.columns * TileGrid::kTile_px;
      const int top = static_cast<int>(tile) / grid.columns * TileGrid::kTile_px;
      for (int y = top; y < std::min(top + TileGrid::kTile_px, grid.height); ++y) {
        for (int x = left; x < std::min(left + TileGrid::kTile_px, grid.width); ++x)
          if (place_at(x, y) == Place::kUnseen && is_open(x, y)) hull.Add(x, y);
      }
    }
  }
  for (BodyHull& hull : hulls) {
    hull.ForEachPixel(grid.width, [&](int x, int y) {
      if (is_open(x, y)) place_at(x, y) = Place::kUnseen;
    });
  }
}

}  // namespace mocap

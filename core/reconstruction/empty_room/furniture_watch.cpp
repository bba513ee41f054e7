#include "core/reconstruction/empty_room/furniture_watch.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "core/errors.h"
#include "core/reconstruction/empty_room/steady_picture.h"

namespace mocap {
namespace {

/// Smaller differences from the background are changes of light, and smaller ones from itself are
/// noise [grey levels of a smooth picture].
constexpr int kClearDifference = 20, kNoiseDifference = 8;
/// A tile that looks otherwise in so many pictures, more than it looks the same, has changed.
constexpr int kRestless = 4;
/// A tile looks otherwise if more than one in so many of its pixels do.
constexpr int kChangedPart = 16;
/// A tile belongs to what stands there if more than one in so many of its pixels differ.
constexpr int kTouchedPart = 8;
/// Furniture stays the same in this share of its tiles, rims included; somebody who stands does
/// not.
constexpr double kLeastStill = 0.8;

int LargestChannel(const Bgr& a, const Bgr& b) {
  return std::max({std::abs(a.b - b.b), std::abs(a.g - b.g), std::abs(a.r - b.r)});
}

}  // namespace

FurnitureWatch::FurnitureWatch(EarlierRoom background, int smallest_px)
    : background_(std::move(background)),
      smallest_px_(smallest_px),
      grid_(background_.color.width(), background_.color.height()),
      tiles_(grid_.size()),
      known_px_(grid_.size()) {
  for (int y = 0; y < grid_.height; ++y) {
    for (int x = 0; x < grid_.width; ++x) known_px_[grid_.TileAt(x, y)] += background_.Knows(x, y);
  }
}

std::vector<StillThing> FurnitureWatch::Add(ImageView<const Bgr> picture, std::int64_t capture_ns) {
  MOCAP_CHECK(picture.width() == grid_.width && picture.height() == grid_.height);
  const Image<Bgr> smooth = Smooth(picture);
  const LightGain gain = LightBetween(background_.color, smooth);
  const Image<Bgr> now = InLight(smooth, {1 / gain[0], 1 / gain[1], 1 / gain[2]});
  Compare(now, capture_ns);
  NameStill(now, capture_ns);
  return Things();
}

void FurnitureWatch::Compare(const Image<Bgr>& now, std::int64_t capture_ns) {
  if (shown_.pixels().empty()) {
    shown_ = now;
    for (Tile& tile : tiles_) tile.since_ns = capture_ns;
  }
  const std::vector<int> changed = CountPixels(now, shown_, kNoiseDifference);
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    Tile& tile = tiles_[i];
    tile.restless =
        std::max(tile.restless + (kChangedPart * changed[i] > known_px_[i] ? 2 : -1), 0);
    if (tile.restless <= kRestless) continue;
    tile = {capture_ns};
    const int left = static_cast<int>(i) % grid_.columns * TileGrid::kTile_px;
    const int top = static_cast<int>(i) / grid_.columns * TileGrid::kTile_px;
    for (int y = top; y < std::min(top + TileGrid::kTile_px, grid_.height); ++y) {
      for (int x = left; x < std::min(left + TileGrid::kTile_px, grid_.width); ++x)
        shown_(x, y) = now(x, y);
    }
  }
  differing_px_ = CountPixels(shown_, background_.color, kClearDifference);
  for (std::size_t i = 0; i < tiles_.size(); ++i)
    tiles_[i].differs = 2 * differing_px_[i] > known_px_[i];
}

/// Counts known pixels of each tile that differ.
std::vector<int> FurnitureWatch::CountPixels(const Image<Bgr>& a, const Image<Bgr>& b,
                                             int difference) const {
  std::vector<int> count(grid_.size());
  for (int y = 0; y < grid_.height; ++y) {
    for (int x = 0; x < grid_.width; ++x)
      count[grid_.TileAt(x, y)] +=
          background_.Knows(x, y) && LargestChannel(a(x, y), b(x, y)) > difference;
  }
  return count;
}

void FurnitureWatch::NameStill(const Image<Bgr>& now, std::int64_t capture_ns) {
  const std::vector<int> differing_now = CountPixels(now, background_.color, kClearDifference);
  std::vector<int> part(grid_.size());
  for (std::size_t i = 0; i < part.size(); ++i)
    part[i] = tiles_[i].differs || kTouchedPart * differing_now[i] > known_px_[i];
  for (const TileGroup& group : GroupTiles(grid_, std::move(part))) {
    const auto still = std::ranges::count_if(
        group.tiles, [&](std::size_t i) { return IsStill(tiles_[i], capture_ns); });
    if (static_cast<double>(still) < kLeastStill * static_cast<double>(group.tiles.size()))
      continue;
    for (const std::size_t i : group.tiles) tiles_[i].is_named |= IsStill(tiles_[i], capture_ns);
  }
}

std::vector<StillThing> FurnitureWatch::Things() const {
  std::vector<int> named(grid_.size());
  for (std::size_t i = 0; i < named.size(); ++i)
    if (tiles_[i].differs && tiles_[i].is_named) named[i] = differing_px_[i];
  std::vector<StillThing> things;
  for (const TileGroup& group : GroupTiles(grid_, std::move(named))) {
    if (group.area_px < smallest_px_) break;
    StillThing thing{group.box, group.area_px, 0};
    for (const std::size_t tile : group.tiles)
      thing.since_ns = std::max(thing.since_ns, tiles_[tile].since_ns);
    things.push_back(thing);
  }
  return things;
}

}  // namespace mocap

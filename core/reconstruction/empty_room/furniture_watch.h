// Beyond the paper: furniture that is moved while people are about.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/empty_room/empty_room.h"
#include "core/reconstruction/empty_room/tile_groups.h"

namespace mocap {

/// Something that stands where the learned studio was empty, or what it hid before.
struct StillThing {
  PixelBox box;  ///< Of whole tiles.
  int area_px = 0;
  std::int64_t since_ns = 0;  ///< When it was first seen as it is.
  friend bool operator==(const StillThing&, const StillThing&) = default;
};

/// Compares a camera's pictures with its background every few seconds.
///
/// What differs clearly and stays the same for a minute, rims included, is furniture. People sway.
/// Somebody who passes by hides furniture for some pictures only. Thread-bound.
class FurnitureWatch {
 public:
  /// Furniture is named after this time.
  static constexpr std::int64_t kStill_ns = 60'000'000'000;

  /// @param background  the learned studio.
  /// @param smallest_px  smaller things are left out.
  FurnitureWatch(EarlierRoom background, int smallest_px);

  /// Adds a picture of the background's size, and returns what stands there, the largest first.
  std::vector<StillThing> Add(ImageView<const Bgr> picture, std::int64_t capture_ns);

 private:
  /// What a tile shows, apart from what hides it for a while.
  struct Tile {
    std::int64_t since_ns = 0;
    int restless = 0;      ///< Grows with each picture in which it looks like another one.
    bool differs = false;  ///< From the background.
    /// It was still when most of what stood there was, so that nobody stood there.
    bool is_named = false;
  };
  static bool IsStill(const Tile& tile, std::int64_t capture_ns) {
    return capture_ns - tile.since_ns >= kStill_ns;
  }

  void Compare(const Image<Bgr>& now, std::int64_t capture_ns);
  std::vector<int> CountPixels(const Image<Bgr>& a, const Image<Bgr>& b, int difference) const;
  void NameStill(const Image<Bgr>& now, std::int64_t capture_ns);
  std::vector<StillThing> Things() const;

  const EarlierRoom background_;
  const int smallest_px_;
  const TileGrid grid_;
  Image<Bgr> shown_;  ///< What each tile shows since its time.
  std::vector<Tile> tiles_;
  std::vector<int> known_px_, differing_px_;  ///< Of each tile.
};

}  // namespace mocap

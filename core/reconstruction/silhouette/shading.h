// Beyond the paper: where a picture is darker than the empty studio, by a shadow or by clothes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// What one picture tells about shadows. Tiles are squares of kTile_px pixels.
struct Shading {
  static constexpr int kTile_px = 8;
  /// Brightness relative to the empty studio, minus one, in steps larger than noise. Brighter
  /// places have 0.
  using Shade = std::int8_t;
  static constexpr float kShadesPerUnit = 64;
  /// The shade of places that the camera does not know.
  static constexpr Shade kUnknown = 1;
  static Shade ShadeOf(float brighter) {
    return static_cast<Shade>(kShadesPerUnit * std::clamp(brighter, -1.0F, 0.0F) - 0.5F);
  }

  /// A tile with dark pixels.
  struct DarkTile {
    std::int16_t column = 0;
    std::int16_t row = 0;
    Shade shade = 0;  ///< Mean of its dark pixels.
    friend bool operator==(const DarkTile&, const DarkTile&) = default;
  };

  /// Pixels beside the silhouette that are darker than the empty studio by more than noise, but not
  /// more than a shadow.
  Silhouette dark;
  std::vector<DarkTile> dark_tiles;
  int tile_columns = 0;
  /// For each tile, row by row.
  std::vector<Shade> shades;
};

/// Lists tiles that have dark pixels in one row of four.
/// @param shade  for every dark pixel.
void ListDarkTiles(ImageView<const float> shade, Shading& shading);

}  // namespace mocap

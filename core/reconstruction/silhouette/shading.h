// Beyond the paper: where a picture is darker than the empty studio, which may be a shadow or
// somebody's clothes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// What one picture tells of shadows. Tiles are squares of kTile_px pixels.
struct Shading {
  static constexpr int kTile_px = 8;
  /// Brightness over that of the empty studio, less one, in steps that noise does not reach; what
  /// is brighter is 0.
  using Shade = std::int8_t;
  static constexpr float kShadesPerUnit = 64;
  /// The shade of what the camera does not know.
  static constexpr Shade kUnknown = 1;
  static Shade ShadeOf(float brighter) {
    return static_cast<Shade>(std::lround(kShadesPerUnit * std::clamp(brighter, -1.0F, 0.0F)));
  }

  /// A tile with dark pixels.
  struct DarkTile {
    std::int16_t column = 0;
    std::int16_t row = 0;
    Shade shade = 0;  ///< Mean of its dark pixels.
    friend bool operator==(const DarkTile&, const DarkTile&) = default;
  };

  /// Pixels beside the silhouette that are darker than the empty studio by more than noise, and by
  /// no more than a shadow.
  Silhouette dark;
  std::vector<DarkTile> dark_tiles;
  int tile_columns = 0;
  /// Of each tile, row by row.
  std::vector<Shade> shades;
};

/// Lists the tiles that have dark pixels in one row of four.
/// @param frame  all of them lie within.
/// @param shade  of every pixel that is dark.
void ListDarkTiles(const PixelBox& frame, ImageView<const float> shade, Shading& shading);

}  // namespace mocap

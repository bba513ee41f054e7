// Beyond the paper: where a picture is darker than the empty studio, which may be a shadow or
// somebody's clothes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// What one picture tells of shadows. Tiles are squares of kTile_px pixels.
struct Shading {
  static constexpr int kTile_px = 8;
  /// The shade of what the camera does not know.
  static constexpr float kUnknown = 1;

  /// A tile with dark pixels.
  struct DarkTile {
    std::int16_t column = 0;
    std::int16_t row = 0;
    float shade = 0;  ///< Mean of its dark pixels.
  };

  /// Pixels beside the silhouette that are darker than the empty studio by more than noise, and by
  /// no more than a shadow.
  Silhouette dark;
  std::vector<DarkTile> dark_tiles;
  int tile_columns = 0;
  /// Of each tile, row by row: its brightness over that of the empty studio, less one.
  std::vector<float> shades;
};

/// Lists the tiles that have dark pixels in one row of four.
/// @param frame  all of them lie within.
/// @param shade  of every pixel that is dark.
void ListDarkTiles(const PixelBox& frame, ImageView<const float> shade, Shading& shading);

}  // namespace mocap

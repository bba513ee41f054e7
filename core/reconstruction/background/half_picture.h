// §4: pictures at half the resolution, to see quickly where something may be.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/background/conditions.h"

namespace mocap {

/// Tiles [begin, end) of a row of tiles.
struct TileRun {
  int row = 0;
  int begin = 0;
  int end = 0;
};

/// A picture at half the resolution in planes: blue, green, red, each pixel the mean of four.
///
/// It is cut into tiles of kTile × kTile pixels, and padded with zeros to whole tiles of the full
/// picture.
struct HalfPicture {
  /// Side of a tile, in pixels of this picture.
  static constexpr int kTile = 4;
  /// Side of a tile, in pixels of the full picture.
  static constexpr int kTile_px = 2 * kTile;

  HalfPicture() = default;
  /// Makes room for the half of a picture of so many pixels.
  HalfPicture(int full_width, int full_height);

  int tile_columns() const { return width / kTile; }
  int tile_rows() const { return height / kTile; }
  std::size_t tiles() const { return static_cast<std::size_t>(tile_columns()) * tile_rows(); }
  std::size_t size() const { return static_cast<std::size_t>(width) * height; }
  TileRun RowOfTiles(int row) const { return {row, 0, tile_columns()}; }
  std::size_t FirstTileOf(const TileRun& run) const {
    return static_cast<std::size_t>(run.row) * tile_columns() + run.begin;
  }
  std::size_t FirstPixelOf(const TileRun& run) const {
    return (static_cast<std::size_t>(run.row) * width + run.begin) * kTile;
  }

  int width = 0;
  int height = 0;
  /// Row by row, and a tile's side longer: two tiles are read at once where one is left.
  std::array<std::vector<std::uint8_t>, 3> color;
  /// Means of the tiles, row by row.
  std::array<std::vector<float>, 3> tile_mean;
};

/// The half of what a camera would see of the empty studio.
class ExpectedHalf {
 public:
  ExpectedHalf() = default;
  /// Makes room for the half of a picture of so many pixels, of which nothing is known.
  ExpectedHalf(int full_width, int full_height);

  /// Takes colours and slopes from a picture at full resolution.
  void LearnFrom(ImageView<const Bgr> picture);

  /// Takes another half's pixels, displaced by less than its size. They are to be averaged.
  void Displace(const ExpectedHalf& from, const Displacement& displacement);

  /// Averages the tiles and lists the steep pixels, after pixels were written.
  void Finish();

  // Pixels go on for a tile's side, as those of `mean` do.
  HalfPicture mean;
  /// σ² [grey levels²] of a pixel of the full picture; kUnknownVariance where nothing is known.
  std::vector<float> variance;
  /// How steep the picture is [grey levels per pixel of the half picture].
  std::vector<std::uint8_t> slope;
  /// Means of the tiles, row by row.
  std::vector<float> tile_variance, tile_slope_sq;
  /// Every so many of those pixels that lie on steep contours and are known.
  std::vector<std::int32_t> steep;
  /// CoarseScan's distance() and shift_px() of pictures of the empty studio.
  float usual_distance = 0;
  float usual_shift_px = 0;

 private:
  // Contours steeper than this [grey levels per pixel of the half] show how far they moved.
  static constexpr int kSteep = 15;
  // Every so many pixels are enough; few pictures are a multiple of that wide.
  static constexpr std::size_t kSteepStep = 7;

  std::vector<std::uint16_t> sums_;
  std::vector<float> columns_;
};

/// Halves a picture and averages its tiles.
void Halve(ImageView<const Bgr> image, HalfPicture& half);

/// Halves some tiles of a picture and averages them.
/// @param half  made for pictures of that size.
void Halve(ImageView<const Bgr> image, const TileRun& run, HalfPicture& half);

/// Measures how steep the brightness of a picture is on its steeper side: an edge is as steep as
/// its step, not half of it.
/// @param brightness  of `width` × `height` pixels.
std::vector<std::uint8_t> SlopeOf(const std::vector<float>& brightness, int width, int height);

}  // namespace mocap

// §4: pictures at half the resolution, for a fast search for changes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/kernels/halving.h"
#include "core/reconstruction/background/conditions.h"

namespace mocap {

/// A picture at half the resolution, in planes: blue, green, red. Each pixel is the mean of four.
///
/// Of each four rows of the full picture, the first two make one row. It consists of tiles of
/// kTile × kTileRows pixels. Zeros pad it to whole tiles of the full picture.
struct HalfPicture {
  /// Width and height of a tile, in pixels of this picture.
  static constexpr int kTile = kernels::kTileSide;
  static constexpr int kTileRows = kernels::kTileRows;
  /// Side of a tile, in pixels of the full picture.
  static constexpr int kTile_px = 2 * kTile;
  /// Rows of the full picture from one row to the next.
  static constexpr int kRowStep_px = kernels::kRowStep_px;
  static_assert(kTileRows * kRowStep_px == kTile_px);

  HalfPicture() = default;
  /// Allocates the half of a picture of the given size.
  HalfPicture(int full_width, int full_height);
  /// Allocates it, if it has another size.
  void Resize(int full_width, int full_height);

  int tile_columns() const { return width / kTile; }
  int tile_rows() const { return height / kTileRows; }
  std::size_t tiles() const { return static_cast<std::size_t>(tile_columns()) * tile_rows(); }
  std::size_t size() const { return static_cast<std::size_t>(width) * height; }
  /// The first pixel of a tile.
  std::size_t FirstPixelOf(int row, int column) const {
    return static_cast<std::size_t>(row) * kTileRows * width + column * kTile;
  }

  int width = 0;
  int height = 0;
  /// Row by row.
  std::array<std::vector<std::uint8_t>, 3> color;
  /// Means of the tiles, row by row.
  std::array<std::vector<float>, 3> tile_mean;
};

/// The expected empty studio at half the resolution.
class ExpectedHalf {
 public:
  ExpectedHalf() = default;
  /// Allocates the half of a picture of the given size; all pixels are unknown.
  ExpectedHalf(int full_width, int full_height);

  /// Takes colours and slopes from a picture at full resolution.
  void LearnFrom(ImageView<const Bgr> picture);

  /// Copies another half's pixels, displaced by less than its size. Finish() must follow.
  void Displace(const ExpectedHalf& from, const Displacement& displacement);

  /// Averages the tiles and lists the steep pixels, after pixels were written.
  void Finish();

  HalfPicture mean;
  /// σ² [grey levels²] of a pixel of the full picture; kUnknownVariance where nothing is known.
  std::vector<float> variance;
  /// Slope of the picture [grey levels per pixel of the half picture].
  std::vector<std::uint8_t> slope;
  /// Means of the tiles, row by row.
  std::vector<float> tile_variance, tile_slope_sq;
  /// Every kSteepStep-th of those pixels that are known and lie on steep contours.
  std::vector<std::int32_t> steep;
  /// CoarseScan's distance() and shift_px() of pictures of the empty studio.
  float usual_distance = 0;
  float usual_shift_px = 0;

 private:
  // Steeper contours than this [grey levels per pixel of the half] show how far they moved.
  static constexpr int kSteep = 15;
  // A sample of the pixels is enough. Few pictures have a width that is a multiple of this.
  static constexpr std::size_t kSteepStep = 7;

  std::vector<std::uint16_t> sums_;
  std::vector<float> columns_;
};

/// Halves a picture and averages its tiles.
/// @param half  allocated for pictures of that size.
void Halve(ImageView<const Bgr> image, HalfPicture& half);

/// A picture at half the resolution with all of its rows: colours and slopes.
struct WholeHalf {
  explicit WholeHalf(ImageView<const Bgr> picture);

  Image<Bgr> color;
  std::vector<std::uint8_t> slope;  ///< [grey levels per pixel of the half]
};

/// Measures the slope of the brightness on the steeper side of each pixel: an edge counts with its
/// full step, not with half of it.
/// @param brightness  `width` × `height` pixels.
std::vector<std::uint8_t> SlopeOf(const std::vector<float>& brightness, int width, int height);

}  // namespace mocap

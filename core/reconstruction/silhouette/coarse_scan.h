// §4: deviation of a whole picture from the empty studio, and the tiles to segment closely.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/kernels/tiles.h"
#include "core/reconstruction/background/conditions.h"
#include "core/reconstruction/background/half_picture.h"
#include "core/reconstruction/silhouette/shading.h"
#include "core/reconstruction/silhouette/silhouette.h"
#include "core/reconstruction/silhouette/silhouette_cleaner.h"

namespace mocap {

/// Compares pictures with the expected ones, tile by tile at half the resolution.
///
/// Conditions are medians over the picture. Whatever covers less than half of its known part does
/// not disturb them. Thread-bound; reuses its memory.
class CoarseScan {
 public:
  /// @param darkest_shadow  brightness distortion below which nothing is a shadow.
  explicit CoarseScan(float darkest_shadow = 0);

  /// Compares a picture. The results are valid until the next one.
  void Compare(const ExpectedHalf& expected, ImageView<const Bgr> image);

  /// Compares the suspicious part of the previous picture, its surroundings, and every kBandRows-th
  /// row of tiles; these rows change with each picture. The rest counts as background. If something
  /// appears beside the region, or contours shift, the whole picture is compared.
  void Watch(const ExpectedHalf& expected, ImageView<const Bgr> image);
  static constexpr int kBandRows = 8;

  /// Conditions without the displacement.
  const Conditions& conditions() const { return conditions_; }
  /// Median distance of tiles from the expected ones [grey levels].
  float distance() const { return distance_; }
  /// Distance of contours from their expected positions [pixels].
  float shift_px() const { return shift_px_; }
  /// The tiles, of HalfPicture::kTile_px pixels, that may show something else than background: one
  /// pixel per tile.
  const Silhouette& suspicious() const { return suspicious_; }
  /// The picture at half the resolution.
  const HalfPicture& live() const { return live_; }
  /// The shade of each tile when it was last scanned; Shading::kUnknown if the empty studio is
  /// unknown there.
  const std::vector<Shading::Shade>& shades() const { return shades_; }

 private:
  struct Tiles {
    // Brightness distortion; the other deviations are in variances.
    std::vector<float> alpha, tint, glare, chi_square;
  };
  void Resize(const ExpectedHalf& expected, ImageView<const Bgr> image);
  void LookAtAll();
  void LookAtRegion();
  void SampleWholeRows();
  void CompareTiles(const ExpectedHalf& expected, ImageView<const Bgr> image);
  void Take(ImageView<const Bgr> image, std::size_t look);
  bool ShowsBesideRegion() const;
  void Conclude();
  float MeasureGain(const ExpectedHalf& expected, int channel);
  float MeasureDistance(const ExpectedHalf& expected);
  float MeasureShift(const ExpectedHalf& expected);
  void FetchPicture(ImageView<const Bgr> image, const TileRun& run);
  void FetchTiles(const ExpectedHalf& expected, const TileRun& run);
  void MeasureTints(const ExpectedHalf& expected, const TileRun& run);
  kernels::TilePixels PixelsOf(const ExpectedHalf& expected, const TileRun& run) const;
  void MeasureChiSquare(const ExpectedHalf& expected, const TileRun& run);
  void Judge(const ExpectedHalf& expected);

  float darkest_shadow_;
  // Runs to scan in this picture. The first `whole_rows_` of them are whole rows.
  std::vector<TileRun> looks_;
  std::size_t whole_rows_ = 0;
  // Tiles that contain everything suspicious of the last picture with a margin, and those of them
  // that are surrounded by such tiles. Shadows are scanned in addition.
  Silhouette region_, inner_region_, shadows_;
  bool knows_region_ = false;
  int first_band_ = 0;
  int full_width_ = 0, full_height_ = 0;
  HalfPicture live_;
  Tiles tiles_;
  std::vector<std::size_t> samples_;  // Some of the tiles in whole rows.
  std::vector<float> values_;
  Conditions conditions_;
  float distance_ = 0, shift_px_ = 0;
  kernels::Allowance allowance_;
  SilhouetteCleaner cleaner_;
  Silhouette suspicious_;
  Silhouette shaded_;  // Tiles darker than the empty studio.
  std::vector<Shading::Shade> shades_;
};

}  // namespace mocap

// §4: deviation of a whole picture from the empty studio, and the tiles to segment closely.
#pragma once

#include <array>
#include <cstddef>
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
  explicit CoarseScan(float darkest_shadow = 0) : darkest_shadow_(darkest_shadow) {}

  /// Compares a picture. The results are valid until the next one, and do not depend on others.
  void Compare(const ExpectedHalf& expected, ImageView<const Bgr> image);

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
  /// The shade of each tile; Shading::kUnknown if the empty studio is unknown there.
  const std::vector<Shading::Shade>& shades() const { return shades_; }

 private:
  void Sample(const ExpectedHalf& expected);
  float MeasureGain(const ExpectedHalf& expected, int channel);
  float MeasureDistance(const ExpectedHalf& expected);
  float MeasureShift(const ExpectedHalf& expected);
  void MeasureTiles(const ExpectedHalf& expected);
  void Judge(const ExpectedHalf& expected);
  kernels::TilePixels PixelsFrom(const ExpectedHalf& expected, int row, int column) const;

  float darkest_shadow_;
  HalfPicture live_;
  std::vector<float> alpha_, tint_, glare_, weight_, chi_square_;  // Of each tile.
  std::vector<std::size_t> samples_;                               // Some of the known tiles.
  std::vector<float> values_, scratch_;
  Conditions conditions_;
  float distance_ = 0, shift_px_ = 0;
  kernels::Allowance allowance_;
  SilhouetteCleaner cleaner_;
  Silhouette suspicious_;
  std::vector<Shading::Shade> shades_;
};

}  // namespace mocap

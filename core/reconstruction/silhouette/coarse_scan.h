// §4: how a picture as a whole differs from the empty studio, and where a closer look is due.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/background/conditions.h"
#include "core/reconstruction/background/half_picture.h"
#include "core/reconstruction/silhouette/shading.h"
#include "core/reconstruction/silhouette/silhouette.h"
#include "core/reconstruction/silhouette/silhouette_cleaner.h"
#include "core/reconstruction/silhouette/tile_comparison.h"

namespace mocap {

/// Compares pictures with what is expected, tile by tile at half the resolution.
///
/// Conditions are medians over the picture: whatever covers less than half of what is known of it
/// does not disturb them. Thread-bound; reuses its memory.
class CoarseScan {
 public:
  /// @param darkest_shadow  the brightness distortion below which nothing is a shadow.
  explicit CoarseScan(float darkest_shadow = 0);

  /// Compares a picture; the results hold until the next one.
  void Compare(const ExpectedHalf& expected, ImageView<const Bgr> image);

  /// Compares what was suspicious in the picture before, what lies around that, and every
  /// kBandRows-th row of tiles: other rows in each picture. The rest is taken for background; when
  /// something shows beside the region, or contours shift, the whole picture is compared.
  void Watch(const ExpectedHalf& expected, ImageView<const Bgr> image);
  static constexpr int kBandRows = 8;

  /// Conditions but for the displacement.
  const Conditions& conditions() const { return conditions_; }
  /// How far tiles lie from what is expected, in the median [grey levels].
  float distance() const { return distance_; }
  /// How far contours lie from where they are expected [pixels].
  float shift_px() const { return shift_px_; }
  /// The tiles, of HalfPicture::kTile_px pixels, where something else than background may be: one
  /// pixel a tile.
  const Silhouette& suspicious() const { return suspicious_; }
  /// The picture at half the resolution.
  const HalfPicture& live() const { return live_; }
  /// The shade of each tile when it was looked at last; Shading::kUnknown where the empty studio is
  /// not known.
  const std::vector<Shading::Shade>& shades() const { return shades_; }

 private:
  struct Tiles {
    // Brightness distortion, and what else differs: all in variances.
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
  TilePixels PixelsOf(const ExpectedHalf& expected, const TileRun& run) const;
  void MeasureChiSquare(const ExpectedHalf& expected, const TileRun& run);
  void Judge(const ExpectedHalf& expected);

  float darkest_shadow_;
  // What is looked at in this picture; so many whole rows come first.
  std::vector<TileRun> looks_;
  std::size_t whole_rows_ = 0;
  // Tiles that everything suspicious in the last picture lies well within, and those that have
  // such tiles all around. Shadows are looked at besides.
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
  Allowance allowance_;
  SilhouetteCleaner cleaner_;
  Silhouette suspicious_;
  Silhouette shaded_;  // Tiles darker than the empty studio.
  std::vector<Shading::Shade> shades_;
};

}  // namespace mocap

// §4: how a picture as a whole differs from the empty studio, and where a closer look is due.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/conditions.h"
#include "core/reconstruction/half_picture.h"
#include "core/reconstruction/silhouette.h"
#include "core/reconstruction/silhouette_cleaner.h"

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

 private:
  struct Tiles {
    std::array<std::vector<float>, 3> mean;
    // Brightness distortion, and what else differs: all in variances.
    std::vector<float> alpha, tint, glare, misfit;
  };
  void Resize(const ExpectedHalf& expected, ImageView<const Bgr> image);
  float MeasureGain(const ExpectedHalf& expected, int channel);
  float MeasureDistance(const ExpectedHalf& expected);
  float MeasureShift(const ExpectedHalf& expected);
  void MeasureTints(const ExpectedHalf& expected);
  void MeasureMisfit(const ExpectedHalf& expected);
  void Judge(const ExpectedHalf& expected);

  float darkest_shadow_;
  int full_width_ = 0, full_height_ = 0;
  HalfPicture live_;
  std::vector<std::uint16_t> row_sums_;
  Tiles tiles_;
  std::vector<float> columns_, alphas_, values_;
  Conditions conditions_;
  float distance_ = 0, drift_ = 0, shift_px_ = 0;
  SilhouetteCleaner cleaner_;
  Silhouette suspicious_;
};

}  // namespace mocap

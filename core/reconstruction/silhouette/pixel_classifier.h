// §4: which pixels are the person's.
#pragma once

#include <array>
#include <cstdint>

#include "core/image.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/silhouette/distortion_scan.h"
#include "core/reconstruction/silhouette/distortion_thresholds.h"
#include "core/reconstruction/silhouette/region_of_interest.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Decides what each pixel of a picture shows. Horprasert, Harwood, Davis 1999.
///
/// A pixel is background, shadow or highlight if its own colour allows that, and if it lies in some
/// window, of either size, that allows it as a whole. Otherwise it is foreground. Pixels outside
/// the region of interest are background. Thread-bound; reuses its memory.
class PixelClassifier {
 public:
  /// @param darkest_shadow  brightness distortion below which nothing is a shadow.
  PixelClassifier(const DistortionThresholds& thresholds, float darkest_shadow);

  /// Classifies a picture. The results are valid until the next one, and as long as `expected`.
  /// @param expected  weighed under these conditions for the measured pixels.
  void Classify(const ExpectedPicture& expected, ImageView<const Bgr> image,
                const Conditions& conditions, const RegionOfInterest& roi);

  const Silhouette& foreground() const { return foreground_; }
  /// Pixels that are rare as background in the training frames, but not clearly foreground.
  const Silhouette& doubtful() const { return doubtful_; }
  /// Pixels darker than the empty studio by more than noise, whether shadow or not.
  const Silhouette& dark() const { return dark_; }
  /// α − 1 of every measured pixel.
  ImageView<const float> alpha_shift() const { return scan_.alpha_shift(); }

 private:
  kernels::DecisionBytes BytesOfRow(int y);

  kernels::DistortionLimits limits_;
  DistortionScan scan_;
  std::array<Silhouette, kernels::kWindows> clear_windows_, doubtful_windows_;
  Silhouette foreground_, doubtful_, dark_, eroded_, eroded_too_;
};

}  // namespace mocap

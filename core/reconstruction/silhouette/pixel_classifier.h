// §4: background, shadow, highlight, foreground.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/silhouette/distortion_scan.h"
#include "core/reconstruction/silhouette/distortion_thresholds.h"
#include "core/reconstruction/silhouette/region_of_interest.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// The four classes of Horprasert, Harwood, Davis 1999.
enum class PixelClass : std::uint8_t { kBackground, kShadow, kHighlight, kForeground };

/// Decides what each pixel of a picture shows.
///
/// A pixel is background, shadow or highlight if its own colour allows that, and if it lies in some
/// window, of either size, that allows it as a whole. Otherwise it is foreground. Pixels outside
/// the region of interest are background. Thread-bound; reuses its memory.
class PixelClassifier {
 public:
  /// Factors by which thresholds must be exceeded. They allow for effects that an empty studio does
  /// not show: tinted shadows, and noise that a codec passes only where something moves. Measured
  /// on takes with true masks; a change by a tenth has little effect.
  static constexpr std::array<float, kernels::kWindows> kWindowMargins = {1.1f, 1.35f};
  /// A single pixel must differ more, because there are many of them.
  static constexpr float kPixelMargin = 1.6f;

  /// @param darkest_shadow  brightness distortion below which nothing is a shadow.
  PixelClassifier(const DistortionThresholds& thresholds, float darkest_shadow);

  /// Classifies a picture. The results are valid until the next one, and as long as `expected`.
  /// @param expected  weighed under these conditions for the measured pixels.
  void Classify(const ExpectedPicture& expected, ImageView<const Bgr> image,
                const Conditions& conditions, const RegionOfInterest& roi);

  /// Returns the class of a measured pixel.
  PixelClass ClassOf(int x, int y) const;
  /// Foreground pixels, within the frame of the region of interest.
  const Silhouette& foreground() const { return foreground_; }
  /// Pixels that are rare as background in the training frames, but not clearly foreground; within
  /// the frame of the region of interest.
  const Silhouette& doubtful() const { return doubtful_; }
  /// Pixels darker than the empty studio by more than noise, whether shadow or not; within the
  /// frame of the region of interest.
  const Silhouette& dark() const { return dark_; }
  /// α − 1 of every measured pixel.
  ImageView<const float> alpha_shift() const { return scan_.alpha_shift(); }

 private:
  void Resize(const RegionOfInterest& roi);

  DistortionThresholds thresholds_;
  float darkest_shadow_;
  const ExpectedPicture* expected_ = nullptr;
  PixelBox frame_;
  DistortionScan scan_;
  Silhouette clear_pixels_;
  std::array<Silhouette, kernels::kWindows> clear_windows_, doubtful_windows_, eroded_;
  Silhouette foreground_, doubtful_, dark_;
};

}  // namespace mocap

// §4: from a picture to a silhouette, for one camera.
#pragma once

#include <memory>
#include <span>

#include "core/image.h"
#include "core/reconstruction/background/background_model.h"
#include "core/reconstruction/background/conditions.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/shading.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Settings of segmentation.
struct SegmentationOptions {
  /// Share of background pixels that shall be called background; thresholds follow from the
  /// histograms.
  double detection_rate = 0.9999;
  /// Brightness, as a share of the background's, below which nothing is a cast shadow: other lamps
  /// and the walls light what one lamp does not.
  double darkest_shadow = 0.7;
  /// Blobs smaller than this share of the picture are dropped.
  double smallest_blob_share = 0.0005;
  /// A blob that is larger than this share of the picture may be a person by itself; of smaller
  /// ones, those that lie apart from the largest are things that were moved.
  double largest_thing_share = 0.02;
};

/// Separates one camera's person from its background: Horprasert's classes, then clean-up.
///
/// Thread-bound: one object a camera thread.
class Segmenter {
 public:
  /// @throws SetupError  when the frames are too few or differ in size from the calibration.
  Segmenter(const CameraCalibration& camera, std::span<const BackgroundFrame> background,
            const SegmentationOptions& options);
  Segmenter(Segmenter&&) noexcept;
  Segmenter& operator=(Segmenter&&) noexcept;
  ~Segmenter();

  /// Segments one frame into `silhouette`, whose memory is reused.
  void Segment(ImageView<const Bgr> image, const PanTiltAngles& angles, Silhouette& silhouette);

  /// What the last picture tells of shadows.
  const Shading& shading() const;
  /// How the last picture as a whole differed from the empty studio.
  const Conditions& conditions() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap

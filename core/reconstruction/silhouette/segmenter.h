// §4: from a picture to person, unknown and empty pixels, for one camera.
#pragma once

#include <memory>
#include <span>

#include "core/image.h"
#include "core/reconstruction/background/conditions.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/background_model.h"
#include "core/reconstruction/silhouette/shading.h"
#include "core/reconstruction/silhouette/trimap.h"

namespace mocap {

/// Settings of segmentation.
struct SegmentationOptions {
  /// Share of background pixels that are classified as background. Thresholds follow from the
  /// histograms.
  double detection_rate = 0.9999;
  /// Brightness, as a share of the background's, below which nothing is a cast shadow: other lamps
  /// and the walls light shadows too.
  double darkest_shadow = 0.7;
  /// Blobs smaller than this share of the picture are dropped.
  double smallest_blob_share = 0.0005;
  /// A blob larger than this share of the picture may be a person. Smaller ones that lie apart from
  /// the largest are moved things.
  double largest_thing_share = 0.02;
};

/// Separates the person from the background in one camera: by the distortions of Horprasert et al.
/// (1999) in windows of pixels, then cleanup.
///
/// Thread-bound: one object per camera thread.
class Segmenter {
 public:
  /// @throws SetupError  if there are too few frames or their size differs from the calibration.
  Segmenter(const CameraCalibration& camera, std::span<const BackgroundFrame> background,
            const SegmentationOptions& options);
  Segmenter(Segmenter&&) noexcept;
  Segmenter& operator=(Segmenter&&) noexcept;
  ~Segmenter();

  /// Segments one frame into `trimap`, whose memory is reused.
  void Segment(ImageView<const Bgr> image, const PanTiltAngles& angles, Trimap& trimap);

  /// Shading of the last picture.
  const Shading& shading() const;
  /// Deviation of the last picture as a whole from the empty studio.
  const Conditions& conditions() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap

// §4: appearance of the empty studio to one camera.
#pragma once

#include <memory>
#include <span>

#include "core/image.h"
#include "core/reconstruction/background/conditions.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/background/half_picture.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/distortion_thresholds.h"
#include "core/reconstruction/silhouette/region_of_interest.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// A picture of the empty studio, with the angles of the pan-tilt head.
struct BackgroundFrame {
  Image<Bgr> image;
  PanTiltAngles angles;
  /// Pixels at which the empty studio was never seen: their colours mean nothing. May be without
  /// size. Only of cameras that do not move.
  Silhouette unseen = {};
};

/// The learned background of one camera. Thread-bound.
class BackgroundModel {
 public:
  virtual ~BackgroundModel() = default;

  /// Turns to the head's angles and returns the expected empty studio at half the resolution. The
  /// result is valid until the next call.
  /// @param displacement  of the picture from where the calibration and the head's angles place it.
  virtual const ExpectedHalf& CoarsePass(const PanTiltAngles& angles,
                                         const Displacement& displacement) = 0;

  /// Returns the expected empty studio at full resolution, weighed, for the measured pixels. The
  /// result is valid until the next call.
  virtual const ExpectedPicture& Expect(const RegionOfInterest& roi,
                                        const Conditions& conditions) = 0;

  /// Thresholds that a given share of the training pixels stays within.
  const DistortionThresholds& thresholds() const { return thresholds_; }

 protected:
  DistortionThresholds thresholds_;
};

/// Learns each pixel's mean and variation from the frames of a camera that does not move.
/// Horprasert, Harwood, Davis 1999.
/// @pre  at least two frames, all of one size.
std::unique_ptr<BackgroundModel> LearnFixedBackground(std::span<const BackgroundFrame> frames,
                                                      double detection_rate);

/// Learns the background of a camera on a pan-tilt head, from one or more frames per direction.
///
/// A pixel is compared with the background in the same direction, in the frame with the nearest
/// head angles. The axes do not pass through the lens, and the nearest frame has the least
/// parallax.
/// @pre  at least two frames, all of the camera's size; the camera has a pan-tilt head.
std::unique_ptr<BackgroundModel> LearnPanTiltBackground(const CameraCalibration& camera,
                                                        std::span<const BackgroundFrame> frames,
                                                        double detection_rate);

}  // namespace mocap

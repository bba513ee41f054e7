// §4: what the empty studio looks like to one camera.
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

namespace mocap {

/// A picture of the empty studio and where the head pointed.
struct BackgroundFrame {
  Image<Bgr> image;
  PanTiltAngles angles;
};

/// The learned background of one camera. Thread-bound.
class BackgroundModel {
 public:
  virtual ~BackgroundModel() = default;

  /// Turns to where the head points, and gives what the camera would see there of the empty studio,
  /// at half the resolution. Holds until the next call.
  /// @param displacement  of the camera's picture from where the calibration and the head say.
  virtual const ExpectedHalf& CoarsePass(const PanTiltAngles& angles,
                                         const Displacement& displacement) = 0;

  /// Gives what the camera would see of it at full resolution, weighed, for the pixels that are
  /// measured. Holds until the next call.
  virtual const ExpectedPicture& Expect(const RegionOfInterest& roi,
                                        const Conditions& conditions) = 0;

  /// Thresholds that a share of the training pixels stays within.
  const DistortionThresholds& thresholds() const { return thresholds_; }

 protected:
  DistortionThresholds thresholds_;
};

/// Learns each pixel's mean and variation from the frames of a camera that does not move.
/// Horprasert, Harwood, Davis 1999.
/// @pre  at least two frames, all of one size.
std::unique_ptr<BackgroundModel> LearnFixedBackground(std::span<const BackgroundFrame> frames,
                                                      double detection_rate);

/// Learns the directions that a camera on a head has been shown, one frame each or more.
///
/// A pixel is compared with the background seen in the same direction, in the frame whose head
/// angles are nearest: the axes do not pass through the lens, and the nearest frame has the least
/// parallax.
/// @pre  at least two frames, all of the camera's size; the camera has a head.
std::unique_ptr<BackgroundModel> LearnPanTiltBackground(const CameraCalibration& camera,
                                                        std::span<const BackgroundFrame> frames,
                                                        double detection_rate);

}  // namespace mocap

// Pan-tilt heads that keep the subject in view.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/reconstruction/camera/camera_model.h"
#include "drivers/pan_tilt.h"
#include "drivers/subject_position.h"

namespace mocap {

/// Turns a head after the subject as on a slack leash. It rests while the subject is near the
/// middle and follows when the subject moves away: ten steps a second, at a speed that keeps
/// pictures sharp. It rests while nobody is tracked. Bound to the head's thread.
class HeadFollower {
 public:
  /// Allowed distance of the subject from the middle of the picture.
  static constexpr double kSlack_rad = 0.06;
  static constexpr double kFastest_rad_s = 1.0;

  /// @param camera  with a head.
  /// @param range   range of angles set for the studio, besides the head's limits.
  HeadFollower(CameraCalibration camera, const PanTiltLimits& range,
               std::shared_ptr<const SubjectPosition> person);

  /// Takes a step. @param now  the head's angles; @param now_ns  the time of a frame.
  void Follow(PanTilt& head, const PanTiltAngles& now, std::int64_t now_ns);

 private:
  PanTiltAngles Next(const PanTiltAngles& aim, const PanTiltLimits& limits, double seconds) const;

  CameraCalibration camera_;
  PanTiltLimits range_;
  std::shared_ptr<const SubjectPosition> person_;
  std::optional<PanTiltAngles> told_;  ///< Last commanded direction.
  std::int64_t last_ns_ = 0;
};

}  // namespace mocap

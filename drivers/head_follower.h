// Heads that keep the person in view.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/reconstruction/camera/camera_model.h"
#include "drivers/pan_tilt.h"
#include "drivers/subject_position.h"

namespace mocap {

/// Turns a head after the person as on a slack leash: what is nearly in the middle stays where it
/// is, and what goes away draws the head along, ten times a second and no faster than pictures stay
/// sharp. While nobody is followed the head rests. Thread-bound, to the head's thread.
class HeadFollower {
 public:
  /// How far from the middle of the picture the person may be.
  static constexpr double kSlack_rad = 0.06;
  static constexpr double kFastest_rad_s = 1.0;

  /// @param camera  with a head.
  /// @param range   how far the studio lets it turn, beside its own limits.
  HeadFollower(CameraCalibration camera, const PanTiltLimits& range,
               std::shared_ptr<const SubjectPosition> person);

  /// Takes a step. @param now  where the head points; @param now_ns  at what time: a frame's.
  void Follow(PanTilt& head, const PanTiltAngles& now, std::int64_t now_ns);

 private:
  PanTiltAngles Next(const PanTiltAngles& aim, const PanTiltLimits& limits, double seconds) const;

  CameraCalibration camera_;
  PanTiltLimits range_;
  std::shared_ptr<const SubjectPosition> person_;
  std::optional<PanTiltAngles> told_;  ///< Where the head was told to turn last.
  std::int64_t last_ns_ = 0;
};

}  // namespace mocap

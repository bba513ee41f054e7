// Angles of a pan-tilt head at any time, interpolated from its readings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Keeps the last readings of a head and interpolates between them. Thread-bound.
class AngleTrack {
 public:
  /// Covers seconds, at one reading per frame.
  static constexpr std::size_t kReadings = 64;

  /// @param time_ns  when the head had these angles; a reading not later than the last is ignored.
  void Add(std::int64_t time_ns, const PanTiltAngles& angles);
  /// Interpolates linearly. Before the first and after the last reading their angles hold. Zero
  /// without a reading.
  PanTiltAngles At(std::int64_t time_ns) const;

 private:
  struct Reading {
    std::int64_t time_ns;
    PanTiltAngles angles;
  };
  std::deque<Reading> readings_;
};

}  // namespace mocap

// Where a head pointed, from readings at some moments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Keeps the last readings and gives the angles between them. Thread-bound.
class AngleTrack {
 public:
  /// Seconds of them, at a reading a frame.
  static constexpr std::size_t kReadings = 64;

  /// @param time_ns  when the head pointed there; what is not later than the last is passed over.
  void Add(std::int64_t time_ns, const PanTiltAngles& angles);
  /// Interpolates linearly; before the first and after the last reading their angles hold. Zero
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

// Fit of a camera's clock to the host's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mocap {

/// Estimates offset and drift of a camera's clock from the stamps and arrival times of its frames.
///
/// Transport delays are never negative, so the true line lies just below all points (device time,
/// arrival minus device time). The least delayed frame of each half second is kept. The slope is
/// that of the edge below the middle of the last minute's lower convex hull. The line is then
/// raised until it touches a point of the last seconds. Neither jitter nor delayed frames can move
/// it. If the clock was set or restarted, it is learned again once several frames agree. A constant
/// delay (readout, transport) remains in the result. Thread-bound; allocates nothing.
class DeviceClock {
 public:
  /// Adds a frame. Each time may have its own epoch [ns].
  void Observe(std::int64_t device_ns, std::int64_t arrival_ns);

  /// Whether a frame is consistent with the clock observed so far.
  bool Fits(std::int64_t device_ns, std::int64_t arrival_ns) const;

  /// Converts device time to host time. @pre  a frame was observed.
  std::int64_t ToHost(std::int64_t device_ns) const { return device_ns + OffsetAt(device_ns); }

  /// Rate of the host's clock relative to the device's; 0 until known.
  double drift_ppm() const { return slope_ * 1e6; }
  /// Number of times that the clock was learned again.
  int restarts() const { return restarts_; }

 private:
  struct Point {
    std::int64_t device_ns = 0;
    std::int64_t offset_ns = 0;  ///< Arrival minus device time.
  };
  static constexpr std::size_t kSlots = 120;

  std::int64_t OffsetAt(std::int64_t device_ns) const;
  bool IsDoubtful(const Point& point, std::int64_t above_ns);
  void Restart(const Point& point);
  void Keep(const Point& point);
  void Fit();
  double HullSlope() const;
  const Point& slot(std::size_t age) const { return slots_[(newest_ + kSlots - age) % kSlots]; }

  std::array<Point, kSlots> slots_;  ///< Ring buffer: the least delayed frame of each half second.
  std::size_t newest_ = 0, used_ = 0;
  std::int64_t slot_begin_ns_ = 0;  ///< Device time at which the newest slot begins.
  std::int64_t first_ns_ = 0, last_ns_ = 0;
  std::int64_t origin_ns_ = 0, base_ns_ = 0;  ///< The line: base at the origin, and slope.
  double slope_ = 0;
  int early_ = 0, late_ = 0, far_too_late_ = 0;
  int restarts_ = 0;
};

}  // namespace mocap

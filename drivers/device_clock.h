// How a camera's own clock runs against the host's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mocap {

/// Learns offset and drift of a camera's clock from when frames were stamped and when they arrived.
///
/// Delays on the way only add, so the true line lies just below all points (device time; arrival
/// minus device time). Of each half second the least delayed frame counts. The line's slope is that
/// of the edge of the last minute's lower convex hull below its middle, and the last seconds lift
/// it as far as they allow; neither jitter nor frames that were held up can move it. A clock that
/// was set or began anew is learned anew, once several frames agree. Some constant delay (reading
/// out, the wire) remains in the result. Thread-bound; allocates nothing.
class DeviceClock {
 public:
  /// Tells of a frame. Times since any epoch each [ns].
  void Observe(std::int64_t device_ns, std::int64_t arrival_ns);

  /// Whether a frame may well be of the clock that was observed so far.
  bool Fits(std::int64_t device_ns, std::int64_t arrival_ns) const;

  /// Gives the host's time of a device time. @pre  some frame was observed.
  std::int64_t ToHost(std::int64_t device_ns) const { return device_ns + OffsetAt(device_ns); }

  /// How much the host's clock gains on the device's; 0 until it is known.
  double drift_ppm() const { return slope_ * 1e6; }
  /// How often the clock was learned anew.
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

  std::array<Point, kSlots> slots_;  ///< A ring; the least delayed frame of each half second.
  std::size_t newest_ = 0, used_ = 0;
  std::int64_t slot_begin_ns_ = 0;  ///< Device time at which the newest slot begins.
  std::int64_t first_ns_ = 0, last_ns_ = 0;
  std::int64_t origin_ns_ = 0, base_ns_ = 0;  ///< The line: base at the origin, and its slope.
  double slope_ = 0;
  int early_ = 0, late_ = 0, far_too_late_ = 0;
  int restarts_ = 0;
};

}  // namespace mocap

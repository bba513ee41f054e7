// From a camera's stamps to the middle of the exposure in the host's time.
#pragma once

#include <cstdint>
#include <string_view>

#include "drivers/device_clock.h"

namespace mocap {

enum class TimeSource {
  kArrival,      ///< The camera does not stamp: when the frame's first packet came.
  kDeviceClock,  ///< The camera's own clock, fitted to the host's.
  kPtp,          ///< The camera's clock is set by PTP.
  kPtpTai,       ///< So it is, and it counts TAI: ahead of UTC by the leap seconds.
};

/// Names a source, for people.
std::string_view Describe(TimeSource source);

/// Finds out when frames were taken.
///
/// Cameras stamp the beginning of the exposure and send once it is over, so that a frame's arrival
/// less its exposure is the least that the host knows. A clock under PTP is taken at its word where
/// it is near the host's, with or without the leap seconds; any other is fitted. Where the host's
/// clock was set, it is seen anew whether they are near.
/// Thread-bound.
class CaptureClock {
 public:
  /// @param leap_seconds  TAI less UTC.
  CaptureClock(bool has_stamps, int leap_seconds)
      : has_stamps_(has_stamps),
        leap_ns_(leap_seconds * 1'000'000'000LL),
        source_(has_stamps ? TimeSource::kDeviceClock : TimeSource::kArrival) {}

  /// Tells that the camera was away: its clock may have begun anew, or gone on.
  void Doubt() { doubted_ = true; }

  /// Gives the middle of the exposure, on the timeline of the arrival [ns].
  /// @param ptp_locked  the camera says that it follows a PTP master.
  /// @param time_of_day_ahead_ns  the host's time of day less the timeline.
  std::int64_t MiddleOfExposure(std::int64_t stamp_ns, std::int64_t arrival_ns,
                                std::int64_t exposure_ns, bool ptp_locked,
                                std::int64_t time_of_day_ahead_ns);

  TimeSource source() const { return source_; }
  double drift_ppm() const { return fit_.drift_ppm(); }

 private:
  TimeSource Choose(std::int64_t ahead_ns, bool ptp_locked) const;

  const bool has_stamps_;
  const std::int64_t leap_ns_;
  TimeSource source_;
  bool doubted_ = false;
  std::int64_t time_of_day_ahead_ns_ = 0;
  DeviceClock fit_;
};

/// TAI less UTC as the kernel was told, or as it has been since 2017.
int LeapSeconds();

}  // namespace mocap

// Conversion of a camera's timestamps to the middle of the exposure in host time.
#pragma once

#include <cstdint>
#include <string_view>

#include "drivers/device_clock.h"

namespace mocap {

enum class TimeSource {
  kArrival,      ///< Arrival of the frame's first packet: the camera has no timestamps.
  kDeviceClock,  ///< The camera's own clock, fitted to the host's.
  kPtp,          ///< The camera's clock is set by PTP.
  kPtpTai,       ///< As kPtp, but counting TAI: ahead of UTC by the leap seconds.
};

/// Names a source, for people.
std::string_view Describe(TimeSource source);

/// Computes capture times of frames.
///
/// Cameras stamp the start of the exposure and send after its end. A frame's arrival minus its
/// exposure is therefore the host's own estimate of the start. A PTP clock is used directly if it
/// is near the host's, with or without the leap seconds; any other clock is fitted. After a step of
/// the host's clock, the distance is checked again. Thread-bound.
class CaptureClock {
 public:
  /// @param leap_seconds  TAI minus UTC.
  CaptureClock(bool has_stamps, int leap_seconds)
      : has_stamps_(has_stamps),
        leap_ns_(leap_seconds * 1'000'000'000LL),
        source_(has_stamps ? TimeSource::kDeviceClock : TimeSource::kArrival) {}

  /// Reports that the camera was away: its clock may have restarted.
  void Doubt() { doubted_ = true; }

  /// Returns the middle of the exposure, on the timeline of the arrival [ns].
  /// @param ptp_locked  the camera reports that it follows a PTP master.
  /// @param time_of_day_ahead_ns  the host's time of day minus the timeline.
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

/// TAI minus UTC as set in the kernel, or the value valid since 2017.
int LeapSeconds();

}  // namespace mocap

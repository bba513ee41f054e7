#include "drivers/v4l2/v4l2_time.h"

#include <linux/videodev2.h>

namespace mocap {
namespace {

/// A frame may have waited for a long time, or have a stamp slightly in the future.
constexpr std::int64_t kOldest_ns = 10'000'000'000;
constexpr std::int64_t kAhead_ns = 1'000'000'000;

bool IsRecent(std::int64_t stamp_ns, std::int64_t now_ns) {
  return stamp_ns > now_ns - kOldest_ns && stamp_ns < now_ns + kAhead_ns;
}

}  // namespace

CaptureTime CaptureTimeOf(std::int64_t stamp_ns, std::uint32_t flags, std::int64_t exposure_ns,
                          HostClock& host) {
  const ClockReading now = host.Read();
  CaptureTime time;
  const bool is_named = (flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  if (IsRecent(stamp_ns, now.monotonic_ns)) {
    time.capture_ns = host.FromMonotonic(stamp_ns);
    time.clock = is_named ? V4l2Clock::kMonotonic : V4l2Clock::kGuessed;
  } else if (IsRecent(stamp_ns, now.time_of_day_ns)) {
    time.capture_ns = host.FromRecentTimeOfDay(stamp_ns, now);
    time.clock = V4l2Clock::kGuessed;
  } else {
    time.capture_ns = host.FromMonotonic(now.monotonic_ns);
  }
  time.is_start_of_exposure =
      time.clock != V4l2Clock::kArrival &&
      (flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  time.capture_ns += time.is_start_of_exposure ? exposure_ns / 2 : -exposure_ns / 2;
  return time;
}

}  // namespace mocap

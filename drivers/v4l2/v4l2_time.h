// From a V4L2 buffer's time stamp to the moment of exposure.
#pragma once

#include <cstdint>

#include "drivers/clock.h"

namespace mocap {

/// Where a frame's time comes from.
enum class V4l2Clock {
  kMonotonic,  ///< The kernel's stamp, by the clock that it names.
  kGuessed,    ///< A stamp without a clock's name that fits one of the kernel's clocks.
  kArrival     ///< No stamp that fits any clock: the moment at which the frame was fetched.
};

struct CaptureTime {
  std::int64_t capture_ns = 0;  ///< Middle of the exposure, on the timeline.
  V4l2Clock clock = V4l2Clock::kArrival;
  bool is_start_of_exposure = false;  ///< What the stamp was of; else of the frame's end.
};

/// Finds the middle of the exposure.
/// @param flags        of the buffer.
/// @param exposure_ns  0: unknown; then the stamp itself is taken.
/// @param host         asked shortly after the buffer came.
CaptureTime CaptureTimeOf(std::int64_t stamp_ns, std::uint32_t flags, std::int64_t exposure_ns,
                          HostClock& host);

}  // namespace mocap

// Conversion of a V4L2 timestamp to the capture time.
#pragma once

#include <cstdint>

#include "drivers/clock.h"

namespace mocap {

/// Origin of a frame's time.
enum class V4l2Clock {
  kMonotonic,  ///< Kernel timestamp, in the clock that it names.
  kGuessed,    ///< Timestamp without a named clock, but consistent with one.
  kArrival     ///< No usable timestamp: the time when the frame was fetched.
};

struct CaptureTime {
  std::int64_t capture_ns = 0;  ///< Middle of the exposure, on the timeline.
  V4l2Clock clock = V4l2Clock::kArrival;
  bool is_start_of_exposure = false;  ///< Whether the stamp is the start of exposure; else the
                                      ///< frame's end.
};

/// Computes the middle of the exposure.
/// @param flags        of the buffer.
/// @param exposure_ns  0: unknown; then the stamp itself is used.
/// @param host         read shortly after the buffer came.
CaptureTime CaptureTimeOf(std::int64_t stamp_ns, std::uint32_t flags, std::int64_t exposure_ns,
                          HostClock& host);

}  // namespace mocap

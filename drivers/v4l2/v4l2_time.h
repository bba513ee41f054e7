// From a V4L2 buffer's time stamp to the moment of exposure.
#pragma once

#include <cstdint>

namespace mocap {

/// Where a frame's time comes from.
enum class V4l2Clock {
  kMonotonic,  ///< The kernel's stamp, by the clock that it names.
  kGuessed,    ///< A stamp without a clock's name that fits one of the kernel's clocks.
  kArrival     ///< No stamp that fits any clock: the moment at which the frame was fetched.
};

/// Both clocks at one moment.
struct ClockPair {
  std::int64_t monotonic_ns = 0;
  std::int64_t epoch_ns = 0;
};
ClockPair ReadClocks();

struct CaptureTime {
  std::int64_t capture_ns = 0;  ///< Middle of the exposure, since the Unix epoch.
  V4l2Clock clock = V4l2Clock::kArrival;
  bool is_start_of_exposure = false;  ///< What the stamp was of; else of the frame's end.
};

/// Finds the middle of the exposure.
/// @param flags        of the buffer.
/// @param exposure_ns  0: unknown; then the stamp itself is taken.
/// @param now          shortly after the buffer came.
CaptureTime CaptureTimeOf(std::int64_t stamp_ns, std::uint32_t flags, std::int64_t exposure_ns,
                          const ClockPair& now);

}  // namespace mocap

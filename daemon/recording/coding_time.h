// Measures how coding threads spend their time, to explain dropped frames.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

namespace mocap {

/// Processor time of a thread since its start, as the kernel counts it.
struct ThreadTimes {
  std::int64_t ran_ns = 0;
  std::int64_t queued_ns = 0;  ///< Ready to run while others ran.
};

/// @return  empty if the kernel does not provide them.
std::optional<ThreadTimes> ReadThreadTimes(pid_t thread);

/// How threads spent the time while frames waited for them.
struct CodingTime {
  std::int64_t ran_ns = 0;
  std::int64_t queued_ns = 0;   ///< Others had the processor.
  std::int64_t blocked_ns = 0;  ///< Waiting for the disk.
  std::int64_t held_ns = 0;     ///< Waiting until tracking has caught up.
  std::int64_t wall_ns = 0;     ///< Duration of the measurement.

  std::int64_t all_ns() const { return ran_ns + queued_ns + blocked_ns + held_ns; }
};

enum class LossCause { kUnknown, kOtherWork, kCodec, kDisk, kPoses };

/// The reason why threads could not write all frames.
/// @param processors  number that they may use.
LossCause CauseOf(const CodingTime& time, int processors);

/// "the processor had other work: stop other programs, …".
std::string TextOf(LossCause cause);

}  // namespace mocap

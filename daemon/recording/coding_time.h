// Where the time of threads that code goes, and what that makes of frames that are lost.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

namespace mocap {

/// Processor time of a thread since it began, as the kernel counts it.
struct ThreadTimes {
  std::int64_t ran_ns = 0;
  std::int64_t queued_ns = 0;  ///< It could have run, and others did.
};

/// @return  empty where the kernel does not tell.
std::optional<ThreadTimes> ReadThreadTimes(pid_t thread);

/// How threads spent the time in which frames waited for them.
struct CodingTime {
  std::int64_t ran_ns = 0;
  std::int64_t queued_ns = 0;   ///< Others had the processor.
  std::int64_t blocked_ns = 0;  ///< They waited for the disk.
  std::int64_t held_ns = 0;     ///< They waited until poses are in time again.
  std::int64_t wall_ns = 0;     ///< How long that was.

  std::int64_t all_ns() const { return ran_ns + queued_ns + blocked_ns + held_ns; }
};

enum class LossCause { kUnknown, kOtherWork, kCodec, kDisk, kPoses };

/// The reason why threads could not write all that there was.
/// @param processors  that they may use.
LossCause CauseOf(const CodingTime& time, int processors);

/// "the processor had other work: stop other programs, …".
std::string TextOf(LossCause cause);

}  // namespace mocap

// What time it is.
#pragma once

#include <chrono>
#include <cstdint>
#include <thread>

namespace mocap {

/// For durations [ns].
inline std::int64_t SteadyNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// Since the Unix epoch [ns].
inline std::int64_t EpochNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Since the Unix epoch [s].
inline std::int64_t EpochS() { return EpochNs() / 1'000'000'000; }

/// Sleeps until a time since the Unix epoch [ns].
inline void SleepUntilEpoch(std::int64_t time_ns) {
  std::this_thread::sleep_until(
      std::chrono::sys_time<std::chrono::nanoseconds>(std::chrono::nanoseconds(time_ns)));
}

}  // namespace mocap

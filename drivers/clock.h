// What time it is: a timeline that never steps, and the host's time of day beside it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

namespace mocap {

/// The monotonic clock, for durations and deadlines [ns].
inline std::int64_t SteadyNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// Both clocks of the host at one moment [ns].
struct ClockReading {
  std::int64_t monotonic_ns = 0;
  std::int64_t time_of_day_ns = 0;  ///< Since the Unix epoch.
  std::int64_t width_ns = 0;        ///< How far apart the two may have been read.
};
ClockReading ReadClocks();

/// Turns the timeline into the host's time of day and back, and notices when that was set.
///
/// The timeline is the monotonic clock, counted from the Unix epoch as the host had it when this
/// object was made. All capture times and deadlines of the program are on it, so that no interval
/// changes when somebody, NTP or a machine that wakes up sets the clock. Linux adjusts the rate of
/// both clocks alike; they part only where the time of day steps.
///
/// Thread-safe; takes no lock and allocates nothing.
class HostClock {
 public:
  explicit HostClock(std::function<ClockReading()> read = ReadClocks);

  ClockReading Read() const { return read_(); }
  /// The timeline's time of a moment by the monotonic clock.
  std::int64_t FromMonotonic(std::int64_t monotonic_ns) const { return monotonic_ns + base_ns_; }
  /// How far the time of day is ahead of the timeline: 0 until the clock is set.
  std::int64_t OffsetNs() { return OffsetNs(read_()); }
  std::int64_t OffsetNs(const ClockReading& now);
  /// The time of day of a moment on the timeline, as the host's clock is set now.
  std::int64_t ToTimeOfDay(std::int64_t timeline_ns) { return timeline_ns + OffsetNs(); }
  /// The timeline's time of a stamp that the host has just made by its time of day, and never in
  /// the future. Soon after a step the stamp may be of before or of after it: whichever makes it
  /// younger.
  std::int64_t FromRecentTimeOfDay(std::int64_t stamp_ns, const ClockReading& now);

 private:
  const std::function<ClockReading()> read_;
  const std::int64_t base_ns_;
  std::atomic<std::int64_t> offset_ns_{0};
  std::atomic<std::int64_t> offset_before_ns_{0};  ///< Until the last step,
  std::atomic<std::int64_t> step_noticed_ns_{0};   ///< and when that was, by the monotonic clock.
};

/// The program's clock. Its timeline begins with the first call.
HostClock& TheHostClock();

/// Where the program's timeline stands [ns].
std::int64_t TimelineNs();
/// Sleeps until a time of the timeline.
void SleepUntil(std::int64_t timeline_ns);

/// The host's time of day since the Unix epoch, for people, files and messages.
std::int64_t TimeOfDayNs();
inline std::int64_t TimeOfDayS() { return TimeOfDayNs() / 1'000'000'000; }

}  // namespace mocap

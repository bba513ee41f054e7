// Clocks: a timeline that never steps, and the host's time of day.
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
  std::int64_t width_ns = 0;        ///< Upper bound of the time between both readings.
};
ClockReading ReadClocks();

/// Converts between the timeline and the host's time of day, and detects steps of the latter.
///
/// The timeline is the monotonic clock, counted from the Unix epoch as known to the host when this
/// object was created. All capture times and deadlines use it. No interval changes when a user, NTP
/// or a resume from suspend sets the clock. Linux adjusts the rate of both clocks equally; they
/// diverge only when the time of day steps.
///
/// Thread-safe; takes no lock and allocates nothing.
class HostClock {
 public:
  explicit HostClock(std::function<ClockReading()> read = ReadClocks);

  ClockReading Read() const { return read_(); }
  /// Converts a monotonic time to the timeline.
  std::int64_t FromMonotonic(std::int64_t monotonic_ns) const { return monotonic_ns + base_ns_; }
  /// Time of day minus timeline: 0 until the clock is set.
  std::int64_t OffsetNs() { return OffsetNs(read_()); }
  std::int64_t OffsetNs(const ClockReading& now);
  /// Converts a time on the timeline to the time of day, by the current setting of the clock.
  std::int64_t ToTimeOfDay(std::int64_t timeline_ns) { return timeline_ns + OffsetNs(); }
  /// Converts a time-of-day stamp that the host has just made to the timeline; never returns a
  /// future time. Soon after a step, the stamp may be from before or after it. The choice that
  /// makes it younger is used.
  std::int64_t FromRecentTimeOfDay(std::int64_t stamp_ns, const ClockReading& now);

 private:
  const std::function<ClockReading()> read_;
  const std::int64_t base_ns_;
  std::atomic<std::int64_t> offset_ns_{0};
  std::atomic<std::int64_t> offset_before_ns_{0};  ///< Offset before the last step.
  std::atomic<std::int64_t> step_noticed_ns_{0};   ///< Monotonic time when the last step was
                                                   ///< noticed.
};

/// The program's clock. Its timeline begins with the first call.
HostClock& TheHostClock();

/// Current time on the timeline [ns].
std::int64_t TimelineNs();
/// Sleeps until a time on the timeline.
void SleepUntil(std::int64_t timeline_ns);

/// The host's time of day since the Unix epoch, for people, files and messages.
std::int64_t TimeOfDayNs();
inline std::int64_t TimeOfDayS() { return TimeOfDayNs() / 1'000'000'000; }

}  // namespace mocap

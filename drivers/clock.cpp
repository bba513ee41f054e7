#include "drivers/clock.h"

#include <algorithm>
#include <cstdlib>
#include <thread>
#include <utility>

namespace mocap {
namespace {

/// Reading both clocks takes time; a step is larger.
constexpr std::int64_t kNoise_ns = 100'000;
/// Attempts, as a reading may be interrupted.
constexpr int kReadings = 3;
constexpr std::int64_t kPrompt_ns = 5'000;
/// No stamp waits longer before it is read.
constexpr std::int64_t kOldestStamp_ns = 10'000'000'000;

std::int64_t BaseOf(const ClockReading& reading) {
  return reading.time_of_day_ns - reading.monotonic_ns;
}

}  // namespace

ClockReading ReadClocks() {
  ClockReading best;
  for (int i = 0; i < kReadings; ++i) {
    const std::int64_t before_ns = SteadyNs();
    const std::int64_t time_of_day_ns = TimeOfDayNs();
    const std::int64_t width_ns = SteadyNs() - before_ns;
    if (i > 0 && width_ns >= best.width_ns) continue;
    best = {before_ns + width_ns / 2, time_of_day_ns, width_ns};
    if (width_ns < kPrompt_ns) break;
  }
  return best;
}

HostClock::HostClock(std::function<ClockReading()> read)
    : read_(std::move(read)), base_ns_(BaseOf(read_())) {}

std::int64_t HostClock::OffsetNs(const ClockReading& now) {
  const std::int64_t offset_ns = BaseOf(now) - base_ns_;
  const std::int64_t known_ns = offset_ns_.load(std::memory_order_acquire);
  if (std::abs(offset_ns - known_ns) <= kNoise_ns + now.width_ns) return known_ns;
  offset_before_ns_.store(known_ns, std::memory_order_relaxed);
  step_noticed_ns_.store(now.monotonic_ns, std::memory_order_relaxed);
  // Last: who reads the new offset also reads when and from what it changed.
  offset_ns_.store(offset_ns, std::memory_order_release);
  return offset_ns;
}

std::int64_t HostClock::FromRecentTimeOfDay(std::int64_t stamp_ns, const ClockReading& now) {
  const std::int64_t now_ns = FromMonotonic(now.monotonic_ns);
  const std::int64_t after_ns = stamp_ns - OffsetNs(now);
  const std::int64_t since_step_ns =
      now.monotonic_ns - step_noticed_ns_.load(std::memory_order_relaxed);
  if (since_step_ns > kOldestStamp_ns) return std::min(after_ns, now_ns);
  const std::int64_t before_ns = stamp_ns - offset_before_ns_.load(std::memory_order_relaxed);
  const auto [older_ns, younger_ns] = std::minmax(after_ns, before_ns);
  return younger_ns <= now_ns ? younger_ns : std::min(older_ns, now_ns);
}

HostClock& TheHostClock() {
  static HostClock clock;
  return clock;
}

std::int64_t TimelineNs() { return TheHostClock().FromMonotonic(SteadyNs()); }

void SleepUntil(std::int64_t timeline_ns) {
  const std::int64_t rest_ns = timeline_ns - TimelineNs();
  std::this_thread::sleep_until(std::chrono::steady_clock::now() +
                                std::chrono::nanoseconds(rest_ns));
}

std::int64_t TimeOfDayNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace mocap

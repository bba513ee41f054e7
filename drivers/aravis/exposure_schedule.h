// Schedule of exposures, and when to request them.
#pragma once

#include <cstdint>
#include <optional>

namespace mocap {

/// Schedules exposures at whole multiples of the period, by a clock that all cameras share and with
/// any epoch. Hosts that do not know each other choose the same instants.
class ExposureSchedule {
 public:
  /// How long before an exposure it is requested. This is less than a period at the usual 30 frames
  /// a second, so a camera need not store more than one. It exceeds usual delays of a busy host or
  /// network.
  static constexpr std::int64_t kAhead_ns = 30'000'000;
  /// An exposure with less time left is skipped.
  static constexpr std::int64_t kLeastAhead_ns = 10'000'000;

  explicit ExposureSchedule(double fps);

  /// Sets how far the cameras' clock is ahead of this host's. After a step, exposures requested by
  /// the old time are forgotten.
  void SetOffset(std::int64_t offset_ns);
  bool knows_time() const { return offset_ns_.has_value(); }

  /// Returns the next exposure in the cameras' clock; each only once. @pre  the time is known.
  /// @param now_ns  of this host's clock.
  std::int64_t Next(std::int64_t now_ns);
  /// When to request that exposure, by this host's clock.
  std::int64_t AskAt() const { return last_ns_ - kAhead_ns - *offset_ns_; }

 private:
  const std::int64_t period_ns_;
  std::optional<std::int64_t> offset_ns_;
  std::int64_t last_ns_ = 0;
};

}  // namespace mocap

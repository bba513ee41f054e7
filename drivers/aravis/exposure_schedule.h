// When a camera is to expose, and when to tell it so.
#pragma once

#include <cstdint>
#include <optional>

namespace mocap {

/// Exposures at the whole multiples of the period by a clock that all cameras share, whichever time
/// that counts: hosts that never heard of each other choose the same instants.
class ExposureSchedule {
 public:
  /// How long before an exposure the camera is told. Less than a period at the usual 30 a second,
  /// so that a camera need not remember more than one; more than a busy machine or network holds
  /// up.
  static constexpr std::int64_t kAhead_ns = 30'000'000;
  /// With less to go an exposure is left out.
  static constexpr std::int64_t kLeastAhead_ns = 10'000'000;

  explicit ExposureSchedule(double fps);

  /// Tells how far the cameras' clock is ahead of this host's. Exposures that were asked for by
  /// another time are forgotten.
  void SetOffset(std::int64_t offset_ns);
  bool knows_time() const { return offset_ns_.has_value(); }

  /// The next exposure, none twice, as the cameras' clock tells it. Only with a known time.
  /// @param now_ns  of this host's clock.
  std::int64_t Next(std::int64_t now_ns);
  /// When, by this host's clock, to ask for that one.
  std::int64_t AskAt() const { return last_ns_ - kAhead_ns - *offset_ns_; }

 private:
  const std::int64_t period_ns_;
  std::optional<std::int64_t> offset_ns_;
  std::int64_t last_ns_ = 0;
};

}  // namespace mocap

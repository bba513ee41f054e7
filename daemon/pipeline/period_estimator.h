// Estimates the frame period from timestamps alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mocap {

/// Estimates one camera's frame period from the times between its latest frames.
///
/// Uses the lower quartile. Missing frames without a gap in the camera's count make some intervals
/// too long, never too short. Jitter hardly moves it. The same stamps give the same estimate.
class PeriodEstimator {
 public:
  /// Adds the next frame; it must be later than the one before.
  /// @param sequence  the camera's count; a gap divides the interval.
  void Add(std::int64_t capture_ns, std::uint64_t sequence);
  /// The period [ns]; 0 before the second frame.
  std::int64_t period_ns() const { return period_ns_; }

 private:
  static constexpr std::size_t kIntervals = 16;

  std::array<std::int64_t, kIntervals> intervals_{};
  std::size_t count_ = 0;  ///< Frames so far.
  std::int64_t last_ns_ = 0;
  std::uint64_t last_sequence_ = 0;
  std::int64_t period_ns_ = 0;
};

}  // namespace mocap

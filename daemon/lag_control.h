// Which frames a pipeline that is behind leaves out.
#pragma once

#include <cstdint>
#include <limits>

namespace mocap {

/// Keeps the age of what is worked on within a few periods, the same way for every camera.
///
/// Cameras that each skip what they have no time for end up with frames of different moments, which
/// make no sets. Here one place says from which moment on frames are wanted: when a set is old,
/// whole periods after it are left out, and the bound lies half-way between two frames.
class LagControl {
 public:
  /// Sets older than this begin to cost frames.
  static constexpr std::int64_t kTolerancePeriods = 4;
  /// How old the first frames after such a gap may be.
  static constexpr std::int64_t kTargetPeriods = 1;

  /// Takes note of a set when it is carved.
  /// @param arrival_ns  when the last of its frames had arrived.
  void Add(std::int64_t capture_ns, std::int64_t arrival_ns, std::int64_t now_ns,
           std::int64_t period_ns);

  /// Frames captured before this are not wanted.
  std::int64_t wanted_from_ns() const { return wanted_from_ns_; }
  /// Sets left out so far.
  std::int64_t skipped() const { return skipped_; }

 private:
  /// What lies between capture and arrival when nothing waits: exposure, transfer, another clock.
  std::int64_t least_delay_ns_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t wanted_from_ns_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t skipped_ = 0;
};

}  // namespace mocap

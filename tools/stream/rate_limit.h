// Limits the rate of messages to a client.
#pragma once

#include <cstdint>

namespace mocap {

/// Limits the average rate. A stream at exactly this rate passes completely, even if some items
/// come a little early.
class RateLimit {
 public:
  /// @param hz  infinity: no limit.
  explicit RateLimit(double hz) : hz_(hz) {}

  /// Whether an item passes. @param time_ns  its time, by any one clock.
  bool Passes(std::int64_t time_ns);

 private:
  static constexpr double kMostSaved = 2;

  const double hz_;
  double saved_ = kMostSaved;  ///< Unused turns.
  std::int64_t before_ns_ = 0;
};

}  // namespace mocap

// Limits the rate of something that comes too often.
#pragma once

#include <cstdint>

namespace mocap {

/// Tells when the next time is due.
class Pacer {
 public:
  explicit Pacer(double hz);
  /// Whether it is due; if so, the next time is a period later. Never at 0 Hz.
  bool IsDue(std::int64_t now_ns);

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
};

}  // namespace mocap

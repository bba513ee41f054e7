// How something that comes too often is done now and then only.
#pragma once

#include <cstdint>

namespace mocap {

/// Says when it is time again.
class Pacer {
 public:
  explicit Pacer(double hz);
  /// Whether it is time now; if so, the next time is a period later. Never with 0 Hz.
  bool IsDue(std::int64_t now_ns);

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
};

}  // namespace mocap

// Frame numbers without wrap-around.
#pragma once

#include <cstdint>

namespace mocap {

/// Converts a camera's frame numbers to a count that never decreases. GigE Vision counts from 1 to
/// 65535 and wraps. Wider numbers are used as they are. If a camera restarts its numbers, the count
/// continues.
class FrameCounter {
 public:
  std::uint64_t Next(std::uint64_t id) {
    if (any_) sequence_ += Step(id);
    any_ = true;
    last_id_ = id;
    return sequence_;
  }
  /// Ignores the distance to the next number: the camera was reopened.
  void Forget() { last_id_ = kNone; }

 private:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
  static constexpr std::uint64_t kPeriod = 65535;

  std::uint64_t Step(std::uint64_t id) const {
    if (last_id_ == kNone) return 1;
    if (id > last_id_) return id - last_id_;
    const bool has_wrapped = last_id_ <= kPeriod && last_id_ - id > kPeriod / 2;
    return has_wrapped ? id + kPeriod - last_id_ : 1;
  }

  std::uint64_t sequence_ = 0;
  std::uint64_t last_id_ = kNone;
  bool any_ = false;
};

}  // namespace mocap

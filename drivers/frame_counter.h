// Frame numbers that wrap, made to go on.
#pragma once

#include <cstdint>

namespace mocap {

/// Turns a camera's own frame numbers into a count that never goes back. GigE Vision counts from 1
/// to 65535 and over again; cameras with wider numbers are taken as they are. One that starts to
/// count anew goes on from where it was.
class FrameCounter {
 public:
  std::uint64_t Next(std::uint64_t id) {
    if (any_) sequence_ += Step(id);
    any_ = true;
    last_id_ = id;
    return sequence_;
  }
  /// The next number means nothing by itself: the camera was opened again.
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

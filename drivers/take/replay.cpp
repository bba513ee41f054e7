#include "drivers/take/replay.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/errors.h"

namespace mocap {
namespace {

class SystemClock : public ReplayClock {
 public:
  std::int64_t NowNs() override {
    return epoch_ns_ + Nanoseconds(std::chrono::steady_clock::now() - start_);
  }

  void SleepUntil(std::int64_t time_ns) override {
    std::this_thread::sleep_until(start_ + std::chrono::nanoseconds(time_ns - epoch_ns_));
  }

 private:
  template <typename Duration>
  static std::int64_t Nanoseconds(Duration duration) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
  }

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const std::int64_t epoch_ns_ = Nanoseconds(std::chrono::system_clock::now().time_since_epoch());
};

}  // namespace

std::unique_ptr<ReplayClock> MakeSystemClock() { return std::make_unique<SystemClock>(); }

std::int64_t Replay::Join() {
  const std::lock_guard lock(mutex_);
  if (cameras_++ > 0 || !clock_) return shift_ns_;
  const std::int64_t now_ns = clock_->NowNs();
  const std::int64_t begin_ns = begin_ns_ ? begin_ns_() : now_ns;
  const std::int64_t loops =
      loop_ ? std::max<std::int64_t>(0, now_ns - begin_ns) / span_.period_ns : 0;
  shift_ns_ = begin_ns - span_.first_ns + loops * span_.period_ns;
  return shift_ns_;
}

void Replay::Leave() {
  const std::lock_guard lock(mutex_);
  MOCAP_CHECK(cameras_ > 0);
  --cameras_;
}

}  // namespace mocap

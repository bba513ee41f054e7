#include "drivers/take/replay.h"

#include <algorithm>

#include "core/errors.h"
#include "drivers/clock.h"

namespace mocap {

std::int64_t TimelineClock::NowNs() { return TimelineNs(); }

void TimelineClock::SleepUntil(std::int64_t time_ns) { mocap::SleepUntil(time_ns); }

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

#include "daemon/recording/coder_watch.h"

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "drivers/clock.h"
#include "drivers/go_behind.h"

namespace mocap {
namespace {

constexpr std::chrono::milliseconds kTick{20};
/// Measurements are discarded when nothing has waited for this long.
constexpr std::int64_t kForgetNs = 1'000'000'000;

}  // namespace

std::int64_t Coder::Waiting() const {
  const FrameTap::Queue& queue = tap->queue();
  const std::int64_t dealt_with = done.load(std::memory_order_acquire) + queue.dropped();
  return std::max<std::int64_t>(queue.pushed() - dealt_with, 0);
}

bool Coder::IsHalfFull() const {
  return 2 * Waiting() > static_cast<std::int64_t>(tap->queue().capacity());
}

bool Urgency::Update(std::int64_t waiting, std::int64_t done, std::int64_t now_ns) {
  const bool has_moved = done != last_done_;
  last_done_ = done;
  // A single frame being coded is normal, if it is another one each time.
  const bool is_behind = waiting > 1 || (waiting == 1 && !has_moved);
  if (!is_behind) {
    behind_since_ns_ = 0;
    if (calm_since_ns_ == 0) calm_since_ns_ = now_ns;
    if (now_ns - calm_since_ns_ >= kCalmNs) is_urgent_ = false;
    return is_urgent_;
  }
  calm_since_ns_ = 0;
  if (behind_since_ns_ == 0) behind_since_ns_ = now_ns;
  if (now_ns - behind_since_ns_ >= kPatienceNs) is_urgent_ = true;
  return is_urgent_;
}

CoderWatch::CoderWatch(std::vector<Coder*> coders, bool can_return)
    : coders_(std::move(coders)), can_return_(can_return), states_(coders_.size()) {
  thread_ = std::thread([this] { Run(); });
}

CoderWatch::~CoderWatch() {
  stop_.store(true);
  thread_.join();
}

std::optional<LossCause> CoderWatch::cause() const {
  const std::scoped_lock lock(mutex_);
  return cause_;
}

void CoderWatch::Run() {
  pthread_setname_np(pthread_self(), "rec watch");
  std::int64_t last_ns = SteadyNs();
  while (!stop_.load()) {
    std::this_thread::sleep_for(kTick);
    const std::int64_t now_ns = SteadyNs();
    Look(now_ns, now_ns - last_ns);
    last_ns = now_ns;
  }
  Look(SteadyNs(), SteadyNs() - last_ns);
}

void CoderWatch::Look(std::int64_t now_ns, std::int64_t passed_ns) {
  bool some_wait = false;
  std::int64_t lost = 0;
  for (std::size_t i = 0; i < coders_.size(); ++i) {
    if (coders_[i]->id.load() == 0) continue;
    Move(*coders_[i], states_[i], now_ns);
    some_wait |= Account(*coders_[i], states_[i], passed_ns);
    const std::int64_t dropped = coders_[i]->tap->queue().dropped();
    lost += dropped - std::exchange(states_[i].dropped, dropped);
  }
  idle_ns_ = some_wait ? 0 : idle_ns_ + passed_ns;
  if (some_wait) time_.wall_ns += passed_ns;
  if (lost > 0) {
    const auto processors = static_cast<int>(std::thread::hardware_concurrency());
    const std::scoped_lock lock(mutex_);
    cause_ = CauseOf(time_, std::max(processors, 1));
  }
  if (idle_ns_ > kForgetNs) time_ = {};
}

void CoderWatch::Move(Coder& coder, State& state, std::int64_t now_ns) const {
  if (!can_return_) return;
  // Once the queue is closed, a caller waits for it.
  const bool is_urgent = state.urgency.Update(coder.Waiting(), coder.done.load(), now_ns) ||
                         coder.tap->queue().closed();
  if (is_urgent == state.is_forward) return;
  state.is_forward = is_urgent;
  is_urgent ? static_cast<void>(BringForward(coder.thread)) : SendBehind(coder.thread);
}

bool CoderWatch::Account(const Coder& coder, State& state, std::int64_t passed_ns) {
  const bool has_work = coder.Waiting() > 0;
  const std::optional<ThreadTimes> times = ReadThreadTimes(coder.id.load());
  const std::optional<ThreadTimes> before = std::exchange(state.times, times);
  if (std::exchange(state.had_work, has_work) && has_work && times && before) {
    const std::int64_t ran_ns = times->ran_ns - before->ran_ns;
    const std::int64_t queued_ns = times->queued_ns - before->queued_ns;
    time_.ran_ns += ran_ns;
    time_.queued_ns += queued_ns;
    const bool is_held = coder.tap->is_held() && !coder.IsHalfFull();
    (is_held ? time_.held_ns : time_.blocked_ns) +=
        std::max<std::int64_t>(passed_ns - ran_ns - queued_ns, 0);
  }
  return has_work;
}

}  // namespace mocap

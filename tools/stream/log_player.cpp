#include "tools/stream/log_player.h"

#include <algorithm>
#include <thread>

#include "core/errors.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

/// A longer pause means that a clock was set, or nothing was logged.
constexpr std::uint64_t kLongestPause_us = 10'000'000;

}  // namespace

LogPlayer::LogPlayer(const std::filesystem::path& log, double speed)
    : log_(log), speed_(speed), reader_(log) {}

bool LogPlayer::Read() {
  const std::int64_t before_us = message_.utime;
  if (!reader_.Next(message_)) return false;
  if (due_ns_ == 0) {
    due_ns_ = SteadyNs();
  } else if (speed_ > 0 && message_.utime > before_us) {
    const std::uint64_t pause_us =
        static_cast<std::uint64_t>(message_.utime) - static_cast<std::uint64_t>(before_us);
    const auto waited_us = static_cast<double>(std::min(pause_us, kLongestPause_us));
    due_ns_ += static_cast<std::int64_t>(1000 * waited_us / speed_);
  }
  return true;
}

bool LogPlayer::Play(std::chrono::nanoseconds longest_wait) {
  if (!has_message_ && !Read()) {
    if (due_ns_ != 0) return false;
    throw SetupError(log_.string() + ": is not an LCM log; expected one that lcm-logger recorded");
  }
  has_message_ = true;
  const std::chrono::nanoseconds wait(std::max<std::int64_t>(0, due_ns_ - SteadyNs()));
  std::this_thread::sleep_for(std::min(wait, longest_wait));
  if (wait > longest_wait) return true;
  has_message_ = false;
  lcm_.publish(message_.channel, message_.bytes.data(),
               static_cast<unsigned>(message_.bytes.size()));
  while (lcm_.handleTimeout(0) > 0) {
  }
  return true;
}

}  // namespace mocap

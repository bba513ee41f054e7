#include "daemon/messages/lcm_sender.h"

#include <cerrno>

#include "drivers/clock.h"

namespace mocap {

bool LcmSender::Send(const std::string& channel, const void* data, std::size_t size) {
  if (is_down()) {
    NoteFailure(ENOTCONN);
    return false;
  }
  errno = 0;
  const int result = lcm_.publish(channel, data, static_cast<unsigned>(size));
  const int error = errno;
  // For a log, only errno reveals that writing failed.
  const bool has_failed = result != 0 || (provider_ == LcmProvider::kFile && error != 0);
  if (!has_failed) return true;
  if (provider_ == LcmProvider::kTcp) is_down_.store(true, std::memory_order_relaxed);
  NoteFailure(error);
  return false;
}

void LcmSender::NoteFailure(int error) {
  if (error != 0) error_.store(error, std::memory_order_relaxed);
  last_failed_ns_.store(SteadyNs(), std::memory_order_relaxed);
  failed_.fetch_add(1, std::memory_order_relaxed);
}

SendStatus LcmSender::Status() const {
  return {.failed = failed_.load(std::memory_order_relaxed),
          .last_failed_ns = last_failed_ns_.load(std::memory_order_relaxed),
          .error = error_.load(std::memory_order_relaxed)};
}

}  // namespace mocap

// Checks whether the daemon's messages arrive, and whether others send on its channels.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "config/config.h"
#include "daemon/messages/lcm_listener.h"
#include "daemon/messages/lcm_sender.h"
#include "daemon/status/channel_status.h"

namespace mocap {

/// Distinguishes own statuses from those of others by their times. Thread-safe.
class StatusRegister {
 public:
  /// Call before sending.
  void NoteSent(std::int64_t utime, std::int64_t now_ns);
  void NoteHeard(std::int64_t utime, std::int64_t now_ns);
  ChannelStatus Status(std::int64_t now_ns) const;

 private:
  static constexpr std::int64_t kNever = -1;

  mutable std::mutex mutex_;
  std::deque<std::int64_t> sent_;
  std::int64_t unheard_since_ns_ = kNever;
  std::int64_t other_ns_ = kNever;
};

/// Listens to the daemon's own status channel in its own thread. Reopens the connection when it
/// receives nothing, because a route may have changed. If LCM needs a server and lost it, asks
/// whether it answers again.
class ChannelWatch {
 public:
  /// @param sender  borrowed for the watch's life.
  ChannelWatch(const LcmConfig& config, LcmSender& sender);
  ~ChannelWatch();

  /// Call before a status is sent.
  void NoteSent(std::int64_t utime);
  ChannelStatus Status() const;

 private:
  void AskServer();

  const LcmUrl address_;
  LcmSender& sender_;
  StatusRegister register_;
  std::atomic<bool> stop_{false};
  std::thread thread_;                   ///< Runs AskServer.
  std::optional<LcmListener> listener_;  ///< Ends before the members that it uses.
};

}  // namespace mocap

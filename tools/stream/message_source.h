// Source of poses: a live address, or a log that is played back.
#pragma once

#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <optional>
#include <string>

#include "tools/stream/log_player.h"

namespace mocap {

/// The messages of one LCM address.
class MessageSource {
 public:
  /// @param url  "file://…" plays a log, as in LogPlayer.
  /// @throws SetupError  that names --url, when it cannot be opened.
  explicit MessageSource(const std::string& url);

  /// Subscribe here.
  lcm::LCM& lcm() { return player_ ? player_->lcm() : *live_; }
  bool is_log() const { return player_.has_value(); }
  /// Waits for messages up to a limit, and passes them to the subscribers.
  /// @return  false at the end of a log. @throws std::runtime_error  when LCM fails.
  bool Handle(std::chrono::milliseconds longest_wait);

 private:
  const std::string url_;
  std::unique_ptr<lcm::LCM> live_;
  std::optional<LogPlayer> player_;  ///< Used in place of `live_`.
};

}  // namespace mocap

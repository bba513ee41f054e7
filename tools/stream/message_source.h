// Where poses come from: a live address, or a log that plays the part of one.
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
  /// @param url  "file://…" plays a log, as LogPlayer does.
  /// @throws SetupError  that names --url, when it cannot be opened.
  explicit MessageSource(const std::string& url);

  /// Where to subscribe.
  lcm::LCM& lcm() { return player_ ? player_->lcm() : *live_; }
  bool is_log() const { return player_.has_value(); }
  /// Waits for messages, for some time at most, and hands what has come to the subscribers.
  /// @return  false at the end of a log. @throws std::runtime_error  when LCM cannot go on.
  bool Handle(std::chrono::milliseconds longest_wait);

 private:
  const std::string url_;
  std::unique_ptr<lcm::LCM> live_;
  std::optional<LogPlayer> player_;  ///< Instead of it.
};

}  // namespace mocap

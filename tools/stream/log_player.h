// A log as if it were live.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <lcm/lcm-cpp.hpp>

#include "daemon/messages/log_reader.h"

namespace mocap {

/// Publishes a log's messages to this process, at the pace at which they were logged. Damage is
/// passed over, as LogReader has it, where LCM's own player would end or run out of memory.
class LogPlayer {
 public:
  /// @param speed  of the playing; 0: as fast as can be.
  /// @throws SetupError  when the file cannot be read.
  LogPlayer(const std::filesystem::path& log, double speed);

  /// Where to subscribe.
  lcm::LCM& lcm() { return lcm_; }
  /// Waits for the next message, for some time at most, and hands it to the subscribers.
  /// @return  false at the end of the log. @throws SetupError  there, when it is no log.
  bool Play(std::chrono::nanoseconds longest_wait);

 private:
  bool Read();

  const std::filesystem::path log_;
  const double speed_;
  lcm::LCM lcm_{"memq://"};
  LogReader reader_;
  LoggedMessage message_;  ///< The next one,
  bool has_message_ = false;
  std::int64_t due_ns_ = 0;  ///< and when its turn comes, by the steady clock; 0: none came yet.
};

}  // namespace mocap

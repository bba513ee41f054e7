// Playback of a log as if it were live.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <lcm/lcm-cpp.hpp>

#include "daemon/messages/log_reader.h"

namespace mocap {

/// Publishes a log's messages to this process at their original pace. Skips damage, as LogReader
/// does; LCM's own player would end or run out of memory.
class LogPlayer {
 public:
  /// @param speed  of the playback; 0: as fast as possible.
  /// @throws SetupError  when the file cannot be read.
  LogPlayer(const std::filesystem::path& log, double speed);

  /// Subscribe here.
  lcm::LCM& lcm() { return lcm_; }
  /// Waits for the next message up to a limit, and passes it to the subscribers.
  /// @return  false at the end of the log. @throws SetupError  there, when it is not a log.
  bool Play(std::chrono::nanoseconds longest_wait);

 private:
  bool Read();

  const std::filesystem::path log_;
  const double speed_;
  lcm::LCM lcm_{"memq://"};
  LogReader reader_;
  LoggedMessage message_;  ///< The next one,
  bool has_message_ = false;
  std::int64_t due_ns_ = 0;  ///< and when it is due, by the steady clock; 0: none was read yet.
};

}  // namespace mocap

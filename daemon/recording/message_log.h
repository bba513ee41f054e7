// An LCM log that opens up to the last message that was written, whatever happens.
#pragma once

#include <lcm/eventlog.h>

#include <filesystem>
#include <memory>

#include "daemon/pipeline/tap.h"

namespace mocap {

/// Writes what lcm-logger would. Thread-bound.
class MessageLog {
 public:
  /// @throws std::runtime_error  here and below, when it cannot be written.
  explicit MessageLog(const std::filesystem::path& file);
  void Write(const TappedMessage& message);
  /// Hands what was written to the system.
  void Flush();

 private:
  struct Closer {
    void operator()(lcm_eventlog_t* log) const { lcm_eventlog_destroy(log); }
  };

  [[noreturn]] void Fail() const;

  std::filesystem::path file_;
  std::unique_ptr<lcm_eventlog_t, Closer> log_;
};

}  // namespace mocap

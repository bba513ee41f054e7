// An LCM log that stays readable up to the last written message, whatever happens.
#pragma once

#include <lcm/eventlog.h>

#include <filesystem>
#include <memory>

#include "daemon/pipeline/tap.h"

namespace mocap {

/// Writes a log like lcm-logger's. Thread-bound.
class MessageLog {
 public:
  /// @throws std::runtime_error  here and below, if it cannot be written.
  explicit MessageLog(const std::filesystem::path& file);
  void Write(const TappedMessage& message);
  /// Passes written data to the operating system.
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

// The daemon's log.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace mocap {

/// Opens the log for its lifetime: standard error (the journal under systemd), and a file if there
/// is a folder for logs. A separate thread writes, so that a stalled disk or reader blocks nothing.
/// If the queue is full, the oldest messages are lost.
class ServiceLog {
 public:
  ServiceLog();
  ~ServiceLog();
  ServiceLog(const ServiceLog&) = delete;
  ServiceLog& operator=(const ServiceLog&) = delete;

  /// Whether its file could not be opened, or a message could not be written during the last
  /// minute. Any thread.
  bool Fails(std::int64_t now_ns) const;

 private:
  bool lacks_file_ = false;
  std::shared_ptr<std::atomic<std::int64_t>> failed_ns_;
};

}  // namespace mocap

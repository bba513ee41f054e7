// Where the daemon's messages go.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace mocap {

/// Opens the log for its life: standard error, which is the journal under systemd, and a file where
/// there is a place. A thread of its own writes, so that a disk or a reader that stalls holds up
/// nothing; what finds no room meanwhile is lost, the oldest first.
class ServiceLog {
 public:
  ServiceLog();
  ~ServiceLog();
  ServiceLog(const ServiceLog&) = delete;
  ServiceLog& operator=(const ServiceLog&) = delete;

  /// Whether there is no file for it where there is a place, or a message could not be written
  /// during the last minute. Any thread.
  bool Fails(std::int64_t now_ns) const;

 private:
  bool lacks_file_ = false;
  std::shared_ptr<std::atomic<std::int64_t>> failed_ns_;
};

}  // namespace mocap

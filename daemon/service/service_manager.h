// Notifies systemd, if it listens.
#pragma once

#include <atomic>
#include <chrono>
#include <string>

namespace mocap {

/// Speaks systemd's notification protocol. For the main thread; a reload may run in another.
class ServiceManager {
 public:
  /// The service is working.
  void Ready();
  bool is_ready() const { return is_ready_.load(); }
  /// Sets the line that `systemctl status` shows; sent when it has changed.
  void Say(const std::string& line);
  /// Call while frames move. Without it for the unit's WatchdogSec, systemd restarts the service.
  void FeedWatchdog();
  /// Call around a reload. Before the service is ready, systemd is told of readiness only.
  void BeginReload();
  void EndReload();
  /// @param most  maximum duration of stopping.
  void Stopping(std::chrono::microseconds most);

 private:
  std::atomic<bool> is_ready_{false};
  std::string line_;
};

}  // namespace mocap

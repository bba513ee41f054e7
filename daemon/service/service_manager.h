// Notifies systemd; does nothing where it does not listen.
#pragma once

#include <atomic>
#include <chrono>
#include <string>

namespace mocap {

/// Speaks systemd's notification protocol. Main thread; a reload may have another.
class ServiceManager {
 public:
  /// The service has begun its work.
  void Ready();
  bool is_ready() const { return is_ready_.load(); }
  /// One line for people, as `systemctl status` shows it; sent when it has changed.
  void Say(const std::string& line);
  /// Frames move; without this for the unit's WatchdogSec the service is restarted.
  void FeedWatchdog();
  /// Around a reload; before the service is ready, systemd hears of readiness alone.
  void BeginReload();
  void EndReload();
  /// @param most  how long that may take.
  void Stopping(std::chrono::microseconds most);

 private:
  std::atomic<bool> is_ready_{false};
  std::string line_;
};

}  // namespace mocap

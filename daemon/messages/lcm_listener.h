// A receiving connection that stays open.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <mutex>
#include <string>
#include <thread>

#include "config/lcm_url.h"

namespace mocap {

/// Receives LCM messages in its own thread, and reopens the connection when none come: routes come,
/// go and change while a program runs.
class LcmListener {
 public:
  /// Both are called from the thread.
  struct Calls {
    std::function<void(lcm::LCM&)> subscribe;  ///< After each opening.
    std::function<bool()> hears;  ///< Some 20 times a second: whether messages come as expected.
  };

  /// @param name    of the thread, at most 15 characters.
  /// @param reopen  after this time without messages.
  LcmListener(std::string name, std::string url, std::chrono::nanoseconds reopen, Calls calls);
  ~LcmListener();
  LcmListener(const LcmListener&) = delete;
  LcmListener& operator=(const LcmListener&) = delete;

  /// Why nothing can be received, as ReceiveFault; empty: it can. From any thread.
  std::string Fault() const;

 private:
  void Run();
  bool CanReceive(const LcmUrl& address);

  const std::string name_, url_;
  const std::chrono::nanoseconds reopen_;
  const Calls calls_;
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  std::string fault_;  ///< Guarded by mutex_.
  std::thread thread_;
};

}  // namespace mocap

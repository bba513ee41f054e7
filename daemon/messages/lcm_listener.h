// A way in that stays open.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <string>
#include <thread>

namespace mocap {

/// Hears LCM's messages in a thread of its own, and opens the way in anew when nothing is heard:
/// routes come, go and change while a program runs.
class LcmListener {
 public:
  /// Both are called from the thread.
  struct Calls {
    std::function<void(lcm::LCM&)> subscribe;  ///< Each time that the way in was opened.
    std::function<bool()> hears;  ///< Some 20 times a second: whether messages come as they should.
  };

  /// @param name    of the thread, at most 15 characters.
  /// @param reopen  after so long without.
  LcmListener(std::string name, std::string url, std::chrono::nanoseconds reopen, Calls calls);
  ~LcmListener();
  LcmListener(const LcmListener&) = delete;
  LcmListener& operator=(const LcmListener&) = delete;

 private:
  void Run();

  const std::string name_, url_;
  const std::chrono::nanoseconds reopen_;
  const Calls calls_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace mocap

// Signals, heard whatever the main thread is at.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace mocap {

/// Holds back SIGINT, SIGTERM and SIGHUP from all threads that start afterwards, and has SIGPIPE
/// ignored: whoever reads our log may go away. Call first in main.
void HoldSignals();

/// Waits for signals in a thread of its own. The first SIGINT or SIGTERM asks the daemon to end;
/// when that takes longer than it may, or with the second, the program ends at once.
class StopSignals {
 public:
  /// How long an end may take that loses nothing: while the daemon starts.
  static constexpr std::chrono::milliseconds kStartPatience{1500};

  /// @pre  HoldSignals was called.
  StopSignals();
  ~StopSignals();

  /// Becomes true when the daemon shall end.
  const std::atomic<bool>& stop() const { return stop_; }
  /// Sleeps for a while, or until a signal comes.
  void Wait(std::chrono::nanoseconds most);
  /// Whether SIGHUP has come since it was last asked.
  bool TakeReload() { return reload_.exchange(false); }
  /// From now on an end may take so long. @param has_take  whether it has a take to complete.
  void Allow(std::chrono::nanoseconds patience, bool has_take) {
    patience_ns_.store(patience.count());
    has_take_.store(has_take);
    is_starting_.store(false);
  }

 private:
  void Run();
  void NoteStop();
  [[noreturn]] void EndNow() const;

  std::atomic<bool> stop_{false};
  std::atomic<bool> reload_{false};
  std::atomic<bool> is_over_{false};
  std::atomic<std::int64_t> patience_ns_{std::chrono::nanoseconds(kStartPatience).count()};
  std::atomic<bool> is_starting_{true};
  std::atomic<bool> has_take_{false};
  std::int64_t stop_ns_ = 0;  ///< The thread's: when the first came.
  std::mutex mutex_;
  std::condition_variable news_;
  bool has_news_ = false;
  std::thread thread_;
};

}  // namespace mocap

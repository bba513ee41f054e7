// Handles signals, whatever the main thread is doing.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace mocap {

/// Blocks SIGINT, SIGTERM and SIGHUP in all threads started afterwards, and ignores SIGPIPE: the
/// reader of our log may disappear. Call first in main.
void HoldSignals();

/// Waits for signals in its own thread. The first SIGINT or SIGTERM asks the daemon to end. If that
/// exceeds its time limit, or a second signal comes, the program ends at once.
class StopSignals {
 public:
  /// Time limit for an end that loses nothing: while the daemon starts.
  static constexpr std::chrono::milliseconds kStartPatience{1500};

  /// @pre  HoldSignals was called.
  StopSignals();
  ~StopSignals();

  /// Becomes true when the daemon must end.
  const std::atomic<bool>& stop() const { return stop_; }
  /// Sleeps for this time, or until a signal comes.
  void Wait(std::chrono::nanoseconds most);
  /// Whether SIGHUP has come since the last call.
  bool TakeReload() { return reload_.exchange(false); }
  /// Sets the time limit for an end. @param has_take  whether there is a take to complete.
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
  std::int64_t stop_ns_ = 0;  ///< Used by the thread: time of the first signal.
  std::mutex mutex_;
  std::condition_variable news_;
  bool has_news_ = false;
  std::thread thread_;
};

}  // namespace mocap

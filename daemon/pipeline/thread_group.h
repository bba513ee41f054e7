// The threads of a frame path.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace mocap {

/// How the threads of a frame path are scheduled.
struct ThreadOptions {
  int priority = 0;             ///< SCHED_FIFO; 0: as everybody.
  std::vector<int> processors;  ///< That the threads keep to; empty: all.
  bool in_long_turns = false;   ///< Throughput counts, and not latency.
};

/// Threads that end together: the first that fails stops all. RequestStop, is_stopped: any thread.
class ThreadGroup {
 public:
  explicit ThreadGroup(ThreadOptions options) : options_(std::move(options)) {}
  ~ThreadGroup() { End(); }
  ThreadGroup(const ThreadGroup&) = delete;
  ThreadGroup& operator=(const ThreadGroup&) = delete;

  /// @param name  at most 15 characters of it are seen.
  void Launch(const std::string& name, std::function<void()> body);
  /// Runs something; what it throws stops the group. Any thread.
  void Guard(const std::function<void()>& body);
  void RequestStop() { stop_.store(true, std::memory_order_relaxed); }
  bool is_stopped() const { return stop_.load(std::memory_order_relaxed); }
  /// Waits for all in the order in which they were launched. @throws what the first failed with.
  void Join();
  /// Stops all and waits.
  void End();

 private:
  const ThreadOptions options_;
  std::vector<std::thread> threads_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> has_failed_{false};
  std::exception_ptr failure_;  ///< Written by the first to fail, read after joining.
};

}  // namespace mocap

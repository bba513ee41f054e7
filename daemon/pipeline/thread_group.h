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
  int priority = 0;             ///< SCHED_FIFO; 0: normal scheduling.
  std::vector<int> processors;  ///< For the threads; empty: all.
  bool in_long_turns = false;   ///< For throughput instead of latency.
};

/// Threads that end together: the first failure stops all. RequestStop, is_stopped: any thread.
class ThreadGroup {
 public:
  explicit ThreadGroup(ThreadOptions options) : options_(std::move(options)) {}
  ~ThreadGroup() { End(); }
  ThreadGroup(const ThreadGroup&) = delete;
  ThreadGroup& operator=(const ThreadGroup&) = delete;

  /// @param name  cut to 15 characters.
  void Launch(const std::string& name, std::function<void()> body);
  /// As Launch, with the next lower real-time priority, if there is one.
  void LaunchBelow(const std::string& name, std::function<void()> body);
  /// Runs a function; an exception from it stops the group. Any thread.
  void Guard(const std::function<void()>& body);
  void RequestStop() { stop_.store(true, std::memory_order_relaxed); }
  bool is_stopped() const { return stop_.load(std::memory_order_relaxed); }
  /// Waits for all, in launch order. @throws what the first failure threw.
  void Join();
  /// Stops all threads and waits for them.
  void End();

 private:
  void LaunchAt(int priority, const std::string& name, std::function<void()> body);

  const ThreadOptions options_;
  std::vector<std::thread> threads_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> has_failed_{false};
  std::exception_ptr failure_;  ///< Written by the first failure, read after joining.
};

}  // namespace mocap

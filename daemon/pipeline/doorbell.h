// Lets a thread sleep until another one has done something: a counter to wait on, without a lock.
#pragma once

#include <atomic>

namespace mocap {

/// Counts events. A thread that has read a count can sleep until it rises. Thread-safe.
///
/// Read the count, check for work, and only then wait for a newer count. Then an event in between
/// cannot be missed.
class Doorbell {
 public:
  int count() const { return count_.load(std::memory_order_acquire); }
  void Ring() {
    count_.fetch_add(1, std::memory_order_release);
    count_.notify_all();
  }
  void WaitPast(int seen) const { count_.wait(seen, std::memory_order_acquire); }

 private:
  // The kernel's futex takes an int directly.
  std::atomic<int> count_{0};
};

}  // namespace mocap

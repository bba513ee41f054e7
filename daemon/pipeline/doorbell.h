// How a thread sleeps until another one has done something: a counter to wait on, without a lock.
#pragma once

#include <atomic>

namespace mocap {

/// Counts events; whoever has seen a count can sleep until there are more. Thread-safe.
///
/// Read the count, look whether there is work, and only then wait for a newer count: an event in
/// between is never slept through.
class Doorbell {
 public:
  int count() const { return count_.load(std::memory_order_acquire); }
  void Ring() {
    count_.fetch_add(1, std::memory_order_release);
    count_.notify_all();
  }
  void WaitPast(int seen) const { count_.wait(seen, std::memory_order_acquire); }

 private:
  // An int is what the kernel's futex takes without a detour.
  std::atomic<int> count_{0};
};

}  // namespace mocap

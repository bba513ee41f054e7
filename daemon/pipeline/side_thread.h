// A thread for work that takes longer than a set may.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/people/side_work.h"
#include "daemon/pipeline/spsc_queue.h"

namespace mocap {

/// Runs work in a thread of its own that gives way to others, but has its share of a processor that
/// is always busy. Work that waits at the end is not run.
class SideThread : public SideWork {
 public:
  using Guard = std::function<void(const std::function<void()>& work)>;

  /// @param processors  that the thread keeps to; empty: all.
  /// @param guard       runs the work and takes care of what it throws.
  SideThread(const std::string& name, const std::vector<int>& processors, Guard guard);
  ~SideThread() override;

  /// One thread at a time.
  bool Begin(std::function<void()> work) override;

 private:
  void Run();

  const Guard guard_;
  Doorbell bell_;
  SpscQueue<std::function<void()>> queue_;
  std::atomic<std::size_t> waiting_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace mocap

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
  /// @param processors  that the thread keeps to; empty: all.
  SideThread(const std::string& name, const std::vector<int>& processors);
  ~SideThread() override;

  /// One thread at a time.
  void Begin(std::function<void()> work) override;

 private:
  void Run();

  Doorbell bell_;
  SpscQueue<std::function<void()>> queue_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace mocap

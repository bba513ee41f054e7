// A thread for work that takes longer than a set.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "core/side_search.h"
#include "daemon/pipeline/spsc_queue.h"
#include "daemon/pipeline/thread_group.h"

namespace mocap {

/// Runs work in its own thread, of lower priority than the frame path. It still gets a share of a
/// processor that is always busy. Work that is queued at the end is not run.
class SideThread : public SideSearches {
 public:
  using Guard = std::function<void(const std::function<void()>& work)>;

  /// @param frame_path  options of the threads that this one must not delay.
  /// @param guard       runs the work and handles its exceptions.
  SideThread(const std::string& name, const ThreadOptions& frame_path, Guard guard);
  ~SideThread() override;

  std::unique_ptr<SideSearch> Begin(std::shared_ptr<MotionCapture> capture) override;
  /// Runs work soon, in order, without waiting. Call from one thread at a time.
  /// @return  false if too much is waiting already: it is not run.
  bool Do(std::function<void()> work);

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

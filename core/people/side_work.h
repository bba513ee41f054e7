// Beyond the paper: runs work that takes longer than one frame set allows.
#pragma once

#include <functional>

namespace mocap {

/// Runs work beside the thread that tracks people.
class SideWork {
 public:
  virtual ~SideWork() = default;

  /// Runs `work` in another thread soon, in order. Does not wait.
  /// @return  false if too much is waiting already: it is not run.
  virtual bool Begin(std::function<void()> work) = 0;
};

}  // namespace mocap

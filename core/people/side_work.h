// Beyond the paper: a place for work that takes longer than a set may.
#pragma once

#include <functional>

namespace mocap {

/// Runs work beside the thread that follows people.
class SideWork {
 public:
  virtual ~SideWork() = default;

  /// Runs `work` in another thread, soon: one after the other, in their order. Does not wait.
  /// @return  false where too much waits already: it is not run.
  virtual bool Begin(std::function<void()> work) = 0;
};

}  // namespace mocap

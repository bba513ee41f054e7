// Lets a search for a body take longer than a set.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "core/side_search.h"

namespace mocap {

/// Runs work in another thread soon, in order, without waiting. @return  false if too much is
/// waiting already: it is not run.
using BeginWork = std::function<bool(std::function<void()> work)>;

/// Lets a capture process observations in another thread. Meanwhile up to 32 of them are copied and
/// wait; their memory is reused. The more of them wait, the farther apart are those that follow, so
/// that they reach up to the present. A search that finds nobody goes on with the latest.
class CaptureBeside : public SideSearch {
 public:
  CaptureBeside(std::shared_ptr<MotionCapture> capture, BeginWork begin);
  ~CaptureBeside() override;

  void See(const Observation& observation, std::int64_t capture_ns) override;
  bool HasCaughtUp() const override;

 private:
  struct Queue;

  std::shared_ptr<Queue> queue_;  // Shared with the work that was begun.
  const BeginWork begin_;
};

}  // namespace mocap

// Beyond the paper: searches for a body without delaying the tracking of others.
#pragma once

#include <cstdint>
#include <memory>

#include "core/motion_capture.h"
#include "core/people/side_work.h"

namespace mocap {

/// Lets a capture process observations in another thread than its owner's, because a search takes
/// longer than one frame set allows. Meanwhile up to 32 observations are copied and wait; their
/// memory is reused. Thread-bound.
class CaptureBeside {
 public:
  /// @param capture  must not be used elsewhere until HasCaughtUp.
  /// @param side     borrowed.
  CaptureBeside(std::shared_ptr<MotionCapture> capture, SideWork& side);
  /// The capture finishes only the observation that it is processing.
  ~CaptureBeside();

  /// Copies what a set shows. Skips it if the last one is more recent than tracking needs, or if
  /// too many wait.
  void See(const Sighting& sighting, std::int64_t capture_ns);
  /// Whether the capture has processed everything. It may then be used until the next See.
  bool HasCaughtUp() const;

 private:
  struct Queue;

  std::shared_ptr<Queue> queue_;  // Shared with the work that was begun.
  SideWork& side_;
};

}  // namespace mocap

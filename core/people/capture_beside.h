// Beyond the paper: a body is looked for without keeping the others waiting.
#pragma once

#include <cstdint>
#include <memory>

#include "core/motion_capture.h"
#include "core/people/side_work.h"

namespace mocap {

/// Lets a capture take in sighting after sighting beside its owner's thread: a search for a body
/// takes longer than a set may. Meanwhile up to 32 sightings are copied and wait; their memory goes
/// round. Thread-bound.
class CaptureBeside {
 public:
  /// @param capture  nobody else uses it until HasCaughtUp.
  /// @param side     borrowed.
  CaptureBeside(std::shared_ptr<MotionCapture> capture, SideWork& side);
  /// The capture takes in no more than what it is at.
  ~CaptureBeside();

  /// Copies what a set shows. Leaves it out where the last is younger than tracking needs, and
  /// where too many wait.
  void See(const Sighting& sighting, std::int64_t capture_ns);
  /// Whether the capture has taken in all that was seen. Until the next See it may be used then.
  bool HasCaughtUp() const;

 private:
  struct Queue;

  std::shared_ptr<Queue> queue_;  // The work that was begun has it, too.
  SideWork& side_;
};

}  // namespace mocap

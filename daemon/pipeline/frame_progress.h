// Whether frames still move: what the watchdog is fed from.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace mocap {

/// How often each thread of the pipeline has come round, at one moment.
struct FrameProgress {
  struct Thread {
    std::int64_t turns = 0;
    bool has_ended = false;
  };
  std::vector<Thread> cameras;  ///< A camera that is lost still comes round.
  Thread carving;
  std::int64_t sets_matched = 0;
  std::int64_t sets_tracked = 0;
};

/// Tells whether every thread of the pipeline has done something since it last said so.
///
/// A camera's thread comes round ten times a second even without frames, the carving thread with
/// the cameras', and tracking whenever there are sets. One that hangs, in a driver's call or a loop
/// of ours, stops the rest of this from mattering.
class ProgressWatch {
 public:
  /// Takes the state of this moment; wanted a few times a second. @return whether all have moved.
  bool HasMoved(const FrameProgress& now);

 private:
  std::optional<FrameProgress> last_;  ///< When all had last moved.
};

}  // namespace mocap

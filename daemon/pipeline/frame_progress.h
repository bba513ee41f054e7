// Whether frames still move. This feeds the watchdog.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace mocap {

/// Number of loop turns of each thread of the pipeline, at one moment.
struct FrameProgress {
  struct Thread {
    std::int64_t turns = 0;
    bool has_ended = false;
  };
  std::vector<Thread> cameras;  ///< The thread of a lost camera keeps turning.
  Thread carving;
  std::int64_t sets_matched = 0;
  std::int64_t sets_tracked = 0;
};

/// Tells whether every thread of the pipeline has made progress since the last time all had.
///
/// A camera's thread turns ten times a second even without frames. The carving thread turns when
/// the cameras' do, and tracking when there are sets. If one hangs, in a driver call or in a loop,
/// HasMoved stays false.
class ProgressWatch {
 public:
  /// Takes the present state; call a few times a second. @return whether all have progressed.
  bool HasMoved(const FrameProgress& now);

 private:
  std::optional<FrameProgress> last_;  ///< When all last had.
};

}  // namespace mocap

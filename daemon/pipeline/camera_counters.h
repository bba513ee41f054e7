// Counters of any source of silhouettes.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>

#include "daemon/pipeline/camera_status.h"
#include "daemon/pipeline/segmented_frame.h"
#include "daemon/pipeline/synchronizer.h"

namespace mocap {

/// A camera's counters, and what the consumer needs to know between frames. One thread writes, any
/// reads.
class CameraCounters {
 public:
  static constexpr std::int64_t kNoneYet = std::numeric_limits<std::int64_t>::min();

  /// @return  whether the state has changed.
  bool Enter(CameraState state) {
    return state_.exchange(state, std::memory_order_relaxed) != state;
  }
  /// Counts a frame, and the missing ones before it. The first frame's number has no meaning, and a
  /// camera that came back restarts its count.
  void CountFrame(std::uint64_t sequence);
  void CountDropped() { dropped_.fetch_add(1, std::memory_order_relaxed); }
  void CountTorn() { torn_.fetch_add(1, std::memory_order_relaxed); }
  /// Stores a frame's time and conditions.
  void Note(const SegmentedFrame& frame);
  void Expect(Expectation expectation) {
    expectation_.store(expectation, std::memory_order_release);
  }
  /// Counts a newly learned background, and resets the light to 1.
  void CountReplacement();

  bool has_frames() const { return frames_.load(std::memory_order_relaxed) > 0; }
  Expectation expectation() const { return expectation_.load(std::memory_order_acquire); }
  std::int64_t newest_ns() const { return newest_ns_.load(std::memory_order_relaxed); }
  /// Whether a frame is worth processing: not before `wanted_from_ns`, unless the clock was put
  /// back.
  bool IsWanted(std::int64_t capture_ns, const std::atomic<std::int64_t>& wanted_from_ns) const;
  void Fill(CameraStatus& status) const;

 private:
  std::uint64_t next_sequence_ = 0;
  std::atomic<CameraState> state_{CameraState::kStarting};
  std::atomic<Expectation> expectation_{Expectation::kPossible};
  std::atomic<std::int64_t> newest_ns_{kNoneYet};
  std::atomic<std::int64_t> frames_{0};
  std::atomic<std::int64_t> dropped_{0};
  std::atomic<std::int64_t> torn_{0};
  std::atomic<int> replacements_{0};
  std::atomic<double> light_{1};
  std::atomic<double> nudged_px_{0};
  std::atomic<bool> is_blind_{false};
};

}  // namespace mocap

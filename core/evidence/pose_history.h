// Where a person was a moment ago, for evidence that comes late.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/body/pose_state.h"

namespace mocap {

/// A person's poses of the last second. Reuses its memory.
class PoseHistory {
 public:
  static constexpr std::int64_t kMemoryNs = 1'000'000'000;

  PoseHistory() { moments_.reserve(kUsualMoments); }
  void Clear() { moments_.clear(); }
  /// @param capture_ns  not before that of any pose so far.
  void Add(std::int64_t capture_ns, const PoseState& pose) {
    if (oldest_ >= moments_.size()) oldest_ = 0;
    if (moments_.empty() || capture_ns - moments_[oldest_].capture_ns < kMemoryNs) {
      moments_.insert(moments_.begin() + static_cast<std::ptrdiff_t>(oldest_), {capture_ns, pose});
    } else {
      moments_[oldest_] = {capture_ns, pose};
    }
    ++oldest_;
  }
  /// The pose nearest in time; null: none is known.
  const PoseState* NearestTo(std::int64_t capture_ns) const {
    const Moment* nearest = nullptr;
    for (const Moment& moment : moments_)
      if (!nearest ||
          std::abs(moment.capture_ns - capture_ns) < std::abs(nearest->capture_ns - capture_ns))
        nearest = &moment;
    return nearest ? &nearest->pose : nullptr;
  }

 private:
  struct Moment {
    std::int64_t capture_ns;
    PoseState pose;
  };

  static constexpr std::size_t kUsualMoments = 128;

  std::vector<Moment> moments_;  ///< A ring.
  std::size_t oldest_ = 0;       ///< In the ring; where the next one goes.
};

}  // namespace mocap

// Some moments of a recording, spread over its length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/calibration/seen_shape.h"

namespace mocap {

/// Keeps a bounded number of evenly spread moments of a sequence of unknown length. Which ones
/// depends on the sequence alone.
class MomentHistory {
 public:
  static constexpr std::size_t kMost = 24;

  /// Whether the set with this number, counted from 0, is to be added.
  bool Wants(std::int64_t set) const { return set % stride_ == 0; }
  /// Adds a wanted set; when there are too many, keeps every second one.
  void Add(SeenMoment moment);
  std::span<const SeenMoment> moments() const { return moments_; }

 private:
  std::int64_t stride_ = 1;
  std::vector<SeenMoment> moments_;
};

}  // namespace mocap

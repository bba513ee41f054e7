// Beyond the paper: searches for a body without delaying the tracking of others.
#pragma once

#include <cstdint>
#include <memory>

#include "core/motion_capture.h"

namespace mocap {

/// A capture that processes observations beside its owner, because a search takes longer than one
/// frame set allows. Destruction ends it; the capture then finishes only the observation that it is
/// processing. Thread-bound.
class SideSearch {
 public:
  virtual ~SideSearch() = default;

  /// Copies what a set shows. May skip sets that tracking does not need.
  virtual void See(const Observation& observation, std::int64_t capture_ns) = 0;
  /// Whether the capture has processed everything. It may then be used until the next See.
  virtual bool HasCaughtUp() const = 0;
};

/// Makes searches that run beside the tracking of people.
class SideSearches {
 public:
  virtual ~SideSearches() = default;

  /// @param capture  must not be used elsewhere until SideSearch::HasCaughtUp.
  virtual std::unique_ptr<SideSearch> Begin(std::shared_ptr<MotionCapture> capture) = 0;
};

}  // namespace mocap

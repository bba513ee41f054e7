// A host's clock that is set while the service runs.
#pragma once

#include <cstdint>
#include <string>

namespace mocap {

/// Tells of each step of the host's time of day once.
class ClockWatch {
 public:
  /// Smaller steps are told when they have added up.
  static constexpr std::int64_t kLeastNs = 10'000'000;

  /// @param ahead_ns  how far the time of day is ahead of the timeline.
  /// @return what to log; empty: nothing has happened.
  std::string Add(std::int64_t ahead_ns);

 private:
  std::int64_t told_ns_ = 0;
};

}  // namespace mocap

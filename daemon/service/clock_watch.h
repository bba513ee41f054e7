// Notices when the host's clock is set while the service runs.
#pragma once

#include <cstdint>
#include <string>

namespace mocap {

/// Reports each step of the host's time of day once.
class ClockWatch {
 public:
  /// Smaller steps are reported when their sum reaches this.
  static constexpr std::int64_t kLeastNs = 10'000'000;

  /// @param ahead_ns  time of day minus timeline.
  /// @return the message to log; empty: no step.
  std::string Add(std::int64_t ahead_ns);

 private:
  std::int64_t told_ns_ = 0;
};

}  // namespace mocap

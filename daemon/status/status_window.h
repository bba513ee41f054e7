// Rates and percentiles of the last seconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "daemon/pipeline/frame_path.h"

namespace mocap {

/// Counters since the start, with rates and timings of the last seconds.
struct StatusReport {
  PipelineStatus status;       ///< Counters; its timings are since the start.
  StageHistograms recent;      ///< Timings within the window.
  std::int64_t window_ns = 0;  ///< How far back "lately" goes; 0: nothing can be said of it.
  double sets_per_second = 0;
  std::int64_t sets_complete_lately = 0;
  std::int64_t sets_partial_lately = 0;
  std::int64_t sets_dropped_lately = 0;
  std::vector<double> frames_per_second;  ///< By camera; of one that was lost, since it came back.
  std::vector<bool> returns;              ///< Likewise: it was lost at the last status.
  std::vector<double> late_per_second;    ///< Likewise: those that found no set.
};

/// Remembers a pipeline's status for some seconds, to tell what is new.
class StatusWindow {
 public:
  static constexpr std::size_t kStatuses = 5;

  /// Adds the status of this moment; wanted every second.
  StatusReport Add(PipelineStatus status, std::int64_t now_ns);

 private:
  struct Past {
    std::int64_t time_ns = 0;
    PipelineStatus status;
  };
  const Past& SinceLost(std::size_t camera) const;

  std::deque<Past> past_;
};

}  // namespace mocap

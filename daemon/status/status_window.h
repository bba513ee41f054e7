// Rates and percentiles over the last seconds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "daemon/pipeline/frame_path.h"

namespace mocap {

/// How long a stage took.
struct StageTiming {
  Stage stage = Stage::kSegment;
  std::int64_t count = 0;
  double p50_ms = 0;
  double p99_ms = 0;
  double max_ms = 0;
};

/// One for each stage.
struct StageTimings {
  std::array<StageTiming, kStageCount> all;

  StageTimings() : StageTimings(StageHistograms()) {}
  StageTimings(const StageHistograms& histograms);  // NOLINT: the same, summarized.
  StageTiming& operator[](Stage stage) { return all[static_cast<std::size_t>(stage)]; }
  const StageTiming& operator[](Stage stage) const { return all[static_cast<std::size_t>(stage)]; }
};

/// Counters since the start, with rates and timings of the last seconds.
struct StatusReport {
  PipelineStatus status;       ///< Counters; its timings cover the time since the start.
  StageTimings recent;         ///< Within the window.
  std::int64_t window_ns = 0;  ///< Length of the window of "lately"; 0: no window yet.
  double sets_per_second = 0;
  std::int64_t sets_complete_lately = 0;
  std::int64_t sets_partial_lately = 0;
  std::int64_t sets_dropped_lately = 0;
  std::vector<double> frames_per_second;  ///< Per camera; since it came back if it was lost.
  std::vector<bool> returns;              ///< Per camera: it was lost at the last status.
  std::vector<double> late_per_second;    ///< Per camera: frames that matched no set.
};

/// Keeps a pipeline's statuses of some seconds, to compute rates.
class StatusWindow {
 public:
  static constexpr std::size_t kStatuses = 5;

  /// Adds the present status; call every second.
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

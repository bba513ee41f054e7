#include "daemon/status/status_window.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace mocap {

StageTimings::StageTimings(const StageHistograms& histograms) {
  for (int i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    const LatencyHistogram& one = histograms[stage];
    all[i] = {stage, one.count(), one.PercentileMs(0.5), one.PercentileMs(0.99), one.MaxMs()};
  }
}

StatusReport StatusWindow::Add(PipelineStatus status, std::int64_t now_ns) {
  StatusReport report;
  report.frames_per_second.resize(status.cameras.size());
  report.late_per_second.resize(status.cameras.size());
  report.returns.resize(status.cameras.size());
  report.recent = status.stages;
  if (!past_.empty()) {
    const auto& [then_ns, then] = past_.front();
    report.window_ns = now_ns - then_ns;
    const double seconds = static_cast<double>(report.window_ns) / 1e9;
    const auto rate = [&](std::int64_t now, std::int64_t before) {
      return seconds > 0 ? static_cast<double>(now - before) / seconds : 0;
    };
    report.recent = status.stages.Since(then.stages);
    report.sets_per_second = rate(status.sets_tracked, then.sets_tracked);
    report.sets_complete_lately = status.sets_complete - then.sets_complete;
    report.sets_partial_lately = status.sets_partial - then.sets_partial;
    report.sets_dropped_lately = status.sets_dropped - then.sets_dropped;
    for (std::size_t i = 0; i < status.cameras.size(); ++i) {
      report.late_per_second[i] = rate(status.cameras[i].late, then.cameras[i].late);
      const Past& since = SinceLost(i);
      report.returns[i] = since.status.cameras[i].state == CameraState::kLost;
      if (now_ns == since.time_ns) continue;
      report.frames_per_second[i] =
          1e9 * static_cast<double>(status.cameras[i].frames - since.status.cameras[i].frames) /
          static_cast<double>(now_ns - since.time_ns);
    }
  }
  past_.push_back({now_ns, status});
  if (past_.size() > kStatuses) past_.pop_front();
  report.status = std::move(status);
  return report;
}

// The oldest status since the camera was last lost; the newest, if it was lost then.
const StatusWindow::Past& StatusWindow::SinceLost(std::size_t camera) const {
  const auto is_lost = [camera](const Past& past) {
    return past.status.cameras[camera].state == CameraState::kLost;
  };
  const auto last_lost = std::find_if(past_.rbegin(), past_.rend(), is_lost);
  return last_lost == past_.rend()     ? past_.front()
         : last_lost == past_.rbegin() ? past_.back()
                                       : *std::prev(last_lost);
}

}  // namespace mocap

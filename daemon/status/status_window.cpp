#include "daemon/status/status_window.h"

#include <utility>

namespace mocap {

StatusReport StatusWindow::Add(PipelineStatus status, std::int64_t now_ns) {
  StatusReport report;
  report.frames_per_second.resize(status.cameras.size());
  report.late_per_second.resize(status.cameras.size());
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
      report.frames_per_second[i] = rate(status.cameras[i].frames, then.cameras[i].frames);
      report.late_per_second[i] = rate(status.cameras[i].late, then.cameras[i].late);
    }
  }
  past_.push_back({now_ns, status});
  if (past_.size() > kStatuses) past_.pop_front();
  report.status = std::move(status);
  return report;
}

}  // namespace mocap

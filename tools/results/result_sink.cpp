#include "tools/results/result_sink.h"

#include <cstdio>
#include <string>

namespace mocap {

void ResultSink::OnSet(const TrackedSet& set) {
  PoseRow& row = result_.poses.emplace_back();
  row.frame = set.frame;
  row.timestamp_ns = set.capture_ns;
  row.state = set.result.state;
  row.has_pose = row.state != CaptureState::kSearching;
  if (row.has_pose) {
    row.paper = set.body.PaperStateOf(set.result.pose);
    row.points_W = set.result.points_W;
    row.residual_mm = set.result.residual_mm;
  }
  row.voxels = set.result.voxels;
  result_.body = RecordOf(set.body);
  acquisition_frames_ = set.acquisition_frames;
  tracked_frames_ += row.state == CaptureState::kTracking;
  if (shows_progress_) {
    const std::string state(kCaptureStateNames[static_cast<std::size_t>(row.state)]);
    std::fprintf(stderr, "\r\x1b[Kframe %lld  %s", static_cast<long long>(row.frame),
                 state.c_str());
  }
}

void ResultSink::EndProgress() const {
  if (shows_progress_) std::fprintf(stderr, "\r\x1b[K");
}

}  // namespace mocap

#include "daemon/pipeline/node_path.h"

#include <utility>

#include "daemon/pipeline/pipeline.h"

namespace mocap {
namespace {

std::vector<StudioCamera> CamerasOf(Studio studio) {
  RequireCameraCount(studio);
  return std::move(studio.cameras);
}

}  // namespace

NodePath::NodePath(Studio studio, const PipelineOptions& options, SilhouetteSink& sink)
    : sink_(sink),
      lines_(CamerasOf(std::move(studio)), options, 0, recorders_, bell_),
      threads_({.priority = options.priority, .processors = options.processors}) {}

NodePath::~NodePath() { threads_.End(); }

void NodePath::Start() {
  lines_.Launch(threads_, wanted_from_ns_);
  threads_.LaunchBelow("send", [this] {
    threads_.Guard([this] { RunSending(); });
    lines_.Close();
    finished_.store(true, std::memory_order_release);
  });
}

void NodePath::RunSending() {
  for (;;) {
    const int seen = bell_.count();
    turns_.fetch_add(1, std::memory_order_relaxed);
    if (SendAll()) return;
    bell_.WaitPast(seen);
  }
}

// @return  whether all cameras have ended.
bool NodePath::SendAll() {
  bool all_ended = true;
  for (int i = 0; i < lines_.count(); ++i) {
    CameraLine& line = lines_[i];
    const bool is_closed = line.queue.closed();
    while (line.queue.TryPop()) {
      sink_.OnSilhouette(i, line.queue.front());
      sent_.fetch_add(1, std::memory_order_relaxed);
    }
    all_ended &= is_closed;
  }
  return all_ended;
}

PipelineStatus NodePath::Status() const {
  PipelineStatus status;
  status.tracks = false;
  status.sets_tracked = sent_.load(std::memory_order_relaxed);
  for (int i = 0; i < lines_.count(); ++i) status.cameras.push_back(lines_.Status(i));
  status.stages = StageHistograms(recorders_);
  return status;
}

FrameProgress NodePath::Progress() const {
  FrameProgress progress;
  progress.cameras = lines_.Progress();
  progress.carving = {turns_.load(std::memory_order_relaxed), finished()};
  return progress;
}

}  // namespace mocap

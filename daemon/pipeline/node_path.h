// The frame path of a camera node: it hands silhouettes on as they are.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <vector>

#include "daemon/pipeline/camera_lines.h"
#include "daemon/pipeline/doorbell.h"
#include "daemon/pipeline/frame_path.h"
#include "daemon/pipeline/thread_group.h"
#include "drivers/studio.h"

namespace mocap {

/// Receives a node's silhouettes, all in one thread.
class SilhouetteSink {
 public:
  virtual ~SilhouetteSink() = default;
  /// @param camera  its index among the node's cameras.
  virtual void OnSilhouette(int camera, const SegmentedFrame& frame) = 0;
};

/// Runs a node: one thread per camera that grabs and segments, and one that hands silhouettes on.
/// Run once.
class NodePath : public FramePath {
 public:
  /// Learns every camera's background. @param sink  borrowed for the path's life.
  /// @throws SetupError  for cameras or backgrounds that cannot be used; LearningStopped.
  NodePath(Studio studio, const PipelineOptions& options, SilhouetteSink& sink);
  ~NodePath() override;

  void Start() override;
  void RequestStop() override { threads_.RequestStop(); }
  bool finished() const override { return finished_.load(std::memory_order_acquire); }
  void Join() override { threads_.Join(); }
  void ReplaceBackground(int camera, std::span<const BackgroundFrame> background) override {
    lines_.ReplaceBackground(camera, background);
  }
  PipelineStatus Status() const override;
  FrameProgress Progress() const override;

 private:
  void RunSending();
  bool SendAll();

  SilhouetteSink& sink_;
  StageRecorders recorders_;
  Doorbell bell_;
  CameraLines lines_;
  // All frames are wanted: only the studio knows how late they are.
  const std::atomic<std::int64_t> wanted_from_ns_{std::numeric_limits<std::int64_t>::min()};
  std::atomic<std::int64_t> turns_{0};
  std::atomic<std::int64_t> sent_{0};
  std::atomic<bool> finished_{false};
  ThreadGroup threads_;
};

}  // namespace mocap

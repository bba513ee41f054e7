// The cameras' threads and the queues that they fill.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/reconstruction/silhouette/segmenter.h"
#include "daemon/pipeline/camera_worker.h"
#include "daemon/pipeline/doorbell.h"
#include "daemon/pipeline/frame_path.h"
#include "daemon/pipeline/spsc_queue.h"
#include "daemon/pipeline/thread_group.h"

namespace mocap {

/// Learning was given up because the program shall end.
struct LearningStopped {};

/// Learns what each camera that has a driver sees of the empty studio, all at the same time.
/// @param stop  as PipelineOptions::stop. @throws SetupError of the first camera whose pictures
/// cannot be used; LearningStopped.
std::vector<Segmenter> LearnBackgrounds(const std::vector<StudioCamera>& cameras,
                                        const SegmentationOptions& options,
                                        const std::atomic<bool>* stop = nullptr);

/// How segmentation is set for so many people.
SegmentationOptions SegmentationOf(const PipelineOptions& options);

/// One camera's source, and the queue that its thread fills.
struct CameraLine {
  CameraLine(std::unique_ptr<SilhouetteSource> of, Overflow overflow, Doorbell& bell);

  std::unique_ptr<SilhouetteSource> source;
  SpscQueue<SegmentedFrame> queue;
  bool ended = false;  ///< Nothing more will come; the consumer's view.
  std::atomic<std::int64_t> turns{0};
  std::atomic<bool> has_ended{false};  ///< The camera's thread is done.
};

/// All cameras' lines, which one thread consumes.
class CameraLines {
 public:
  /// Learns the backgrounds. @param bell  rung whenever there may be something to do; borrowed, as
  /// the recorders are. @param rays  of an outline, at the most; 0: outlines are not traced.
  /// @throws SetupError  for backgrounds that cannot be used; LearningStopped.
  CameraLines(std::vector<StudioCamera> cameras, const PipelineOptions& options, int rays,
              StageRecorders& recorders, Doorbell& bell);

  /// A thread a camera. @param wanted_from_ns  as SilhouetteSource::Next has it; borrowed.
  void Launch(ThreadGroup& threads, const std::atomic<std::int64_t>& wanted_from_ns);
  /// Nothing more is taken out.
  void Close();

  int count() const { return static_cast<int>(lines_.size()); }
  CameraLine& operator[](int camera) { return *lines_[static_cast<std::size_t>(camera)]; }
  const CameraLine& operator[](int camera) const {
    return *lines_[static_cast<std::size_t>(camera)];
  }

  /// As FramePath has it.
  void ReplaceBackground(int camera, std::span<const BackgroundFrame> background);
  /// A camera's own counters, and what its queue lost.
  CameraStatus Status(int camera) const;
  std::vector<FrameProgress::Thread> Progress() const;

 private:
  void Run(CameraLine& line, ThreadGroup& threads, const std::atomic<std::int64_t>& wanted_from_ns);

  const SegmentationOptions segmentation_;
  Doorbell& bell_;
  std::vector<std::unique_ptr<CameraLine>> lines_;
  std::vector<CameraWorker*> workers_;  ///< Of the first lines, which have drivers.
};

}  // namespace mocap

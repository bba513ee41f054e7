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

/// Learning was abandoned because the program is to end.
struct LearningStopped {};

/// Learns the background of each camera that has a driver, all at the same time.
/// @param stop  as PipelineOptions::stop.
/// @throws SetupError  of the first camera whose pictures cannot be used; LearningStopped.
std::vector<Segmenter> LearnBackgrounds(const std::vector<StudioCamera>& cameras,
                                        const SegmentationOptions& options,
                                        const std::atomic<bool>* stop = nullptr);

/// Segmentation options for the number of people in `options`.
SegmentationOptions SegmentationOf(const PipelineOptions& options);

/// One camera's source, and the queue that its thread fills.
struct CameraLine {
  CameraLine(std::unique_ptr<SilhouetteSource> of, Overflow overflow, Doorbell& bell);

  std::unique_ptr<SilhouetteSource> source;
  SpscQueue<SegmentedFrame> queue;
  bool ended = false;  ///< Nothing more will come, as the consumer sees it.
  std::atomic<std::int64_t> turns{0};
  std::atomic<bool> has_ended{false};  ///< The camera's thread has ended.
};

/// The lines of all cameras. One thread consumes them.
class CameraLines {
 public:
  /// Learns the backgrounds.
  /// @param recorders  borrowed.
  /// @param bell  rung when there may be something to do; borrowed.
  /// @param rays  maximum number per outline; 0: outlines are not traced.
  /// @throws SetupError  for backgrounds that cannot be used; LearningStopped.
  CameraLines(std::vector<StudioCamera> cameras, const PipelineOptions& options, int rays,
              StageRecorders& recorders, Doorbell& bell);

  /// Starts one thread per camera. @param wanted_from_ns  as in SilhouetteSource::Next; borrowed.
  void Launch(ThreadGroup& threads, const std::atomic<std::int64_t>& wanted_from_ns);
  /// Closes the queues: the consumer takes out nothing more.
  void Close();

  int count() const { return static_cast<int>(lines_.size()); }
  CameraLine& operator[](int camera) { return *lines_[static_cast<std::size_t>(camera)]; }
  const CameraLine& operator[](int camera) const {
    return *lines_[static_cast<std::size_t>(camera)];
  }

  /// As in FramePath.
  void ReplaceBackground(int camera, std::span<const BackgroundFrame> background);
  /// A camera's own counters, and the frames that its queue dropped.
  CameraStatus Status(int camera) const;
  std::vector<FrameProgress::Thread> Progress() const;

 private:
  void Run(CameraLine& line, ThreadGroup& threads, const std::atomic<std::int64_t>& wanted_from_ns);

  const SegmentationOptions segmentation_;
  Doorbell& bell_;
  std::vector<std::unique_ptr<CameraLine>> lines_;
  std::vector<CameraWorker*> workers_;  ///< The first lines' workers: these cameras have drivers.
};

}  // namespace mocap

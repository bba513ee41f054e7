// What cameras and carving see, for whoever looks at the studio; made beside the frames' way.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <mocap/preview_t.hpp>
#include <mocap/voxels_t.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "config/config.h"
#include "core/reconstruction/camera/camera_model.h"
#include "daemon/messages/lcm_sender.h"
#include "daemon/messages/messages.h"
#include "daemon/pipeline/doorbell.h"
#include "daemon/pipeline/pacer.h"
#include "daemon/pipeline/pose_sink.h"
#include "daemon/pipeline/tap.h"
#include "drivers/pixels/jpeg_encoder.h"
#include "drivers/studio.h"

namespace mocap {

/// A tracked set's voxels and bodies on their way to be looked at.
struct SeenBodies {
  struct Body {
    std::optional<BodyModel> model;
    PoseState pose;
  };
  std::int64_t frame = 0;
  std::int64_t capture_ns = 0;
  std::vector<Body> bodies;
  VoxelGrid grid;
};

/// Publishes each camera's picture with its silhouette, and the voxels with their parts, while
/// somebody looks: in a thread of its own that comes after everything else. While nobody does, it
/// costs nothing.
///
/// OnSet: the pipeline's last thread. Look: any.
class PreviewPublisher : public PoseSink {
 public:
  /// Pictures of each camera a second, and voxels, at most.
  static constexpr double kHz = kPreviewHz;
  static constexpr int kWidest_px = 400;

  /// @param sender  borrowed for the publisher's life.
  PreviewPublisher(LcmSender& sender, const LcmConfig& config,
                   const std::vector<CameraCalibration>& cameras, CaptureTimes times);
  ~PreviewPublisher() override;

  /// Where the pipeline's cameras leave what they see.
  std::deque<PreviewTap>& taps() { return taps_; }
  void OnSet(const TrackedSet& set) override;
  /// Somebody looks for so long from now on.
  void Look(std::chrono::seconds duration);

 private:
  void Run();
  void OpenOrClose();
  bool PublishWhatIsThere();
  void Publish(std::size_t camera, const SeenFrame& seen);
  void Publish(const SeenBodies& seen);
  std::int64_t Utime(std::int64_t capture_ns) const;

  LcmSender& sender_;
  const std::string preview_channel_, voxels_channel_;
  const std::vector<CameraCalibration> cameras_;
  const CaptureTimes times_;
  std::deque<PreviewTap> taps_;
  Tap<SeenBodies> body_tap_;
  Pacer body_pacer_{kHz};
  Doorbell bell_;
  std::atomic<std::int64_t> look_until_ns_{0};  ///< By the steady clock.
  std::atomic<bool> stop_{false};
  bool is_open_ = false;
  // Kept so that their memory is reused.
  JpegEncoder encoder_;
  Image<Bgr> reduced_;
  preview_t preview_;
  voxels_t voxels_;
  std::vector<std::uint8_t> bytes_;
  std::thread thread_;
};

}  // namespace mocap

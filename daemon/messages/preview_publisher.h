// Publishes camera pictures and carved voxels for viewers, outside the frame path.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <mocap/preview_t.hpp>
#include <mocap/unknown_t.hpp>
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

/// A tracked set's voxels and bodies for viewing.
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

/// Publishes each camera's picture with its trimap, and the voxels with their parts, while
/// somebody watches. It runs in its own thread of low priority. Without viewers it costs nothing.
///
/// OnSet: the pipeline's last thread. Look: any thread.
class PreviewPublisher : public PoseSink {
 public:
  /// Maximum rate of pictures per camera, and of voxels.
  static constexpr double kHz = kPreviewHz;
  static constexpr int kWidest_px = 400;

  /// @param sender  borrowed for the publisher's life.
  PreviewPublisher(LcmSender& sender, const LcmConfig& config,
                   const std::vector<CameraCalibration>& cameras, CaptureTimes times);
  ~PreviewPublisher() override;

  /// The pipeline's cameras offer their pictures here.
  std::deque<PreviewTap>& taps() { return taps_; }
  void OnSet(const TrackedSet& set) override;
  /// Publishes for this duration from now on.
  void Look(std::chrono::seconds duration);

 private:
  void Run();
  void OpenOrClose();
  bool PublishWhatIsThere();
  void Publish(std::size_t camera, const SeenFrame& seen);
  void PublishUnknown(const Silhouette& unknown);
  void Publish(const SeenBodies& seen);
  std::int64_t Utime(std::int64_t capture_ns) const;

  LcmSender& sender_;
  const std::string preview_channel_, unknown_channel_, voxels_channel_;
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
  unknown_t unknown_;
  voxels_t voxels_;
  std::vector<std::uint8_t> bytes_;
  std::thread thread_;
};

}  // namespace mocap

// Sends a camera node's data to its studio.
#pragma once

#include <cstdint>
#include <mocap/node_t.hpp>
#include <mocap/silhouette_t.hpp>
#include <span>
#include <string>
#include <vector>

#include "config/config.h"
#include "core/reconstruction/camera/camera_model.h"
#include "daemon/messages/lcm_sender.h"
#include "daemon/pipeline/node_path.h"
#include "daemon/pipeline/pacer.h"

namespace mocap {

/// Publishes silhouettes and the node's status. OnSilhouette: one thread; Tell: another.
class SilhouetteSender : public SilhouetteSink {
 public:
  /// @param sender  borrowed for life. @param cameras  of the node.
  SilhouetteSender(LcmSender& sender, const Config& config,
                   std::span<const CameraCalibration> cameras);

  void OnSilhouette(int camera, const SegmentedFrame& frame) override;
  /// Publishes the node's status, if due.
  void Tell(const std::vector<CameraStatus>& cameras, const std::vector<std::string>& complaints);

 private:
  LcmSender& sender_;
  const std::string silhouette_channel_, node_channel_;
  std::vector<silhouette_t> messages_;  ///< One per camera; their memory is reused.
  std::vector<std::uint8_t> bytes_, node_bytes_;
  node_t node_;
  Pacer node_pacer_;
};

}  // namespace mocap

// Receives what clients send to the daemon.
#pragma once

#include <cstdint>
#include <mocap/keypoints_t.hpp>
#include <optional>
#include <span>
#include <vector>

#include "config/config.h"
#include "core/reconstruction/camera/camera_model.h"
#include "daemon/messages/lcm_listener.h"
#include "daemon/pipeline/keypoint_inbox.h"
#include "daemon/pipeline/tap.h"
#include "drivers/studio.h"

namespace mocap {

/// Listens to clients in its own thread, and puts their keypoints into an inbox.
///
/// Members that are public for tests: one thread, before Listen.
class ClientListener {
 public:
  /// @param times   kind of capture times; clients have present ones by the host's time of day.
  /// @param inbox   borrowed for the listener's life.
  /// @param tap     gets what the inbox takes; likewise.
  ClientListener(const LcmConfig& config, std::vector<CameraCalibration> cameras,
                 CaptureTimes times, KeypointInbox& inbox, MessageTap& tap);

  /// Does nothing if the address is one where nobody can send.
  void Listen();

  /// Handles a message from the network, which may contain anything.
  void OnKeypoints(std::span<const std::uint8_t> bytes);
  /// Notes that something can be received here.
  void OnStatus();

 private:
  bool Take(const keypoints_t& message);

  const LcmConfig lcm_;
  const std::vector<CameraCalibration> cameras_;
  const CaptureTimes times_;
  KeypointInbox& inbox_;
  MessageTap& tap_;
  std::int64_t heard_ns_ = 0;            ///< By the steady clock.
  std::optional<LcmListener> listener_;  ///< Ends before the members that it uses.
};

}  // namespace mocap

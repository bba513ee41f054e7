// Receives what clients send to the daemon.
#pragma once

#include <cstdint>
#include <functional>
#include <mocap/keypoints_t.hpp>
#include <mocap/look_request_t.hpp>
#include <optional>
#include <span>
#include <vector>

#include "config/config.h"
#include "core/reconstruction/camera/camera_model.h"
#include "daemon/messages/lcm_listener.h"
#include "daemon/pipeline/keypoint_inbox.h"
#include "daemon/pipeline/keypoint_tap.h"
#include "daemon/pipeline/tap.h"
#include "drivers/studio.h"

namespace mocap {

/// Listens to clients in its own thread. Puts their keypoints into an inbox and passes on what
/// pictures they ask for.
///
/// Members that are public for tests: one thread, before Listen.
class ClientListener {
 public:
  using Ask = std::function<void(const look_request_t&)>;

  /// @param times   kind of capture times; clients have present ones by the host's time of day.
  /// @param inbox   borrowed for the listener's life.
  /// @param messages, keypoints  get what the inbox takes; likewise.
  /// @param ask     is called from the listener's thread.
  ClientListener(const LcmConfig& config, std::vector<CameraCalibration> cameras,
                 CaptureTimes times, KeypointInbox& inbox, MessageTap& messages,
                 KeypointTap& keypoints, Ask ask);

  /// Does nothing if the address is one where nobody can send.
  void Listen();

  /// Handle a message from the network, which may contain anything.
  void OnKeypoints(std::span<const std::uint8_t> bytes);
  void OnLookRequest(std::span<const std::uint8_t> bytes);
  /// Notes that something can be received here.
  void OnStatus();

 private:
  bool Take(const keypoints_t& message);

  const LcmConfig lcm_;
  const std::vector<CameraCalibration> cameras_;
  const CaptureTimes times_;
  KeypointInbox& inbox_;
  MessageTap& messages_;
  KeypointTap& keypoints_;
  const Ask ask_;
  std::int64_t heard_ns_ = 0;            ///< By the steady clock.
  std::optional<LcmListener> listener_;  ///< Ends before the members that it uses.
};

}  // namespace mocap

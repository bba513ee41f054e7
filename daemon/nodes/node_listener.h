// What the nodes of a studio send.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mocap/node_t.hpp>
#include <mocap/silhouette_t.hpp>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "config/config.h"
#include "core/reconstruction/camera/camera_model.h"
#include "daemon/messages/lcm_listener.h"
#include "daemon/nodes/node_record.h"
#include "daemon/nodes/remote_camera.h"
#include "daemon/status/node_report.h"
#include "drivers/clock.h"

namespace mocap {

/// Hears the nodes in a thread of its own and hands each camera's silhouettes to its source. What
/// comes from strangers, or from a node whose clock is off, goes no further, and is told.
///
/// Report: any thread; what is public for tests: one thread, while Listen has not been called.
class NodeListener {
 public:
  /// @param cameras      those of the nodes at least. @pre  every camera that a node has is among
  /// them.
  /// @param time_of_day  the clock here [ns].
  NodeListener(const Config& config, std::span<const CameraCalibration> cameras,
               std::function<std::int64_t()> time_of_day = TimeOfDayNs);

  void Listen();
  /// The source of a node's camera; it must not outlive the listener.
  std::unique_ptr<SilhouetteSource> Open(const CameraCalibration& camera, int rays);
  NodesReport Report();

  /// Take a message from the network, which may be anything.
  void OnSilhouette(std::span<const std::uint8_t> bytes);
  void OnNode(std::span<const std::uint8_t> bytes);
  /// Tells each camera's source whether its node is there.
  void LookRound();

 private:
  struct Camera {
    Camera(const CameraCalibration& calibration, const std::string& node)
        : inbox(calibration, node) {}

    RemoteInbox inbox;
    std::int64_t session = 0;
    std::int64_t next_number = 0;
  };
  struct Node {
    explicit Node(NodeRecord of) : record(std::move(of)) {}

    NodeRecord record;
    std::deque<Camera> cameras;
  };

  Node* Find(const std::string& name);
  static Camera* FindCamera(Node& node, const std::string& name);
  static std::int64_t CountMissed(const silhouette_t& message, Camera& camera);
  static void Deliver(const silhouette_t& message, Camera& camera);
  void NoteStranger(const std::string& name);

  const LcmConfig lcm_;
  const std::function<std::int64_t()> time_of_day_;
  std::int64_t heard_ns_ = 0;
  std::mutex mutex_;  ///< Of the records, and of the strangers.
  std::deque<Node> nodes_;
  std::string stranger_;                 ///< Who sent last that is not known here,
  std::int64_t stranger_ns_ = 0;         ///< and when.
  std::optional<LcmListener> listener_;  ///< Ends before what it tells.
};

}  // namespace mocap

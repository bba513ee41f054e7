// Receives what a studio's nodes send.
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

/// Listens to the nodes in its own thread, and passes each camera's silhouettes to its source.
/// Messages of unknown senders, or of nodes with a wrong clock, are not passed on, but reported.
///
/// Report: any thread. Members that are public for tests: one thread, before Listen.
class NodeListener {
 public:
  /// @param cameras      at least those of the nodes. @pre  it contains every camera of a node.
  /// @param time_of_day  the clock here [ns].
  NodeListener(const Config& config, std::span<const CameraCalibration> cameras,
               std::function<std::int64_t()> time_of_day = TimeOfDayNs);

  void Listen();
  /// Opens the source of a node's camera. It must not outlive the listener.
  std::unique_ptr<SilhouetteSource> Open(const CameraCalibration& camera, int rays);
  NodesReport Report();

  /// Handle a message from the network, which may contain anything.
  void OnSilhouette(std::span<const std::uint8_t> bytes);
  void OnNode(std::span<const std::uint8_t> bytes);
  /// Tells each camera's source whether its node is connected.
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
  std::mutex mutex_;  ///< Guards the records and the strangers.
  std::deque<Node> nodes_;
  std::string stranger_;                 ///< Last unknown sender,
  std::int64_t stranger_ns_ = 0;         ///< and its time.
  std::optional<LcmListener> listener_;  ///< Ends before the members that it uses.
};

}  // namespace mocap

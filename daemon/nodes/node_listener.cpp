#include "daemon/nodes/node_listener.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <lcm/lcm-cpp.hpp>
#include <optional>
#include <utility>

#include "core/errors.h"
#include "daemon/messages/channel_name.h"
#include "daemon/messages/decode_message.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

constexpr std::chrono::seconds kReopen{2};
/// Maximum queue in LCM while this thread does not run.
constexpr int kMostWaiting = 256;
/// How long an unknown sender is reported.
constexpr std::int64_t kLatelyNs = 3'000'000'000;
constexpr std::size_t kLongestName = 64;
/// Larger times and camera counts are invalid.
constexpr std::int64_t kMostNs = std::int64_t{1} << 61;

/// No node sends this many silhouettes. It bounds the sum of missing ones.
constexpr std::int64_t kMostMessages = std::int64_t{1} << 40;

bool IsTime(std::int64_t ns) { return ns >= 0 && ns < kMostNs; }

/// Whether the numbers are plausible for a node.
bool IsSound(const silhouette_t& message) {
  return IsTime(message.capture_ns) && IsTime(message.sent_ns) && message.number >= 0 &&
         message.number < kMostMessages && IsTime(message.sequence) && IsTime(message.segment_ns) &&
         std::isfinite(message.pan_rad) && std::isfinite(message.tilt_rad) &&
         std::isfinite(message.light) && std::isfinite(message.nudged_px);
}

template <void (NodeListener::*Take)(std::span<const std::uint8_t>)>
void Pass(const lcm::ReceiveBuffer* buffer, const std::string&, NodeListener* listener) {
  (listener->*Take)({static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
}

std::vector<CameraCalibration> CamerasOf(const StudioNode& node,
                                         std::span<const CameraCalibration> cameras) {
  std::vector<CameraCalibration> found;
  for (const std::string& name : node.cameras) {
    const auto camera = std::ranges::find(cameras, name, &CameraCalibration::name);
    MOCAP_CHECK(camera != cameras.end());
    found.push_back(*camera);
  }
  return found;
}

}  // namespace

NodeListener::NodeListener(const Config& config, std::span<const CameraCalibration> cameras,
                           std::function<std::int64_t()> time_of_day)
    : lcm_(config.lcm), time_of_day_(std::move(time_of_day)) {
  for (const StudioNode& named : config.nodes) {
    const std::vector<CameraCalibration> calibrations = CamerasOf(named, cameras);
    Node& node = nodes_.emplace_back(NodeRecord(named.name, calibrations));
    for (const CameraCalibration& camera : calibrations)
      node.cameras.emplace_back(camera, named.name);
  }
}

void NodeListener::Listen() {
  const auto subscribe = [this](lcm::LCM& lcm) {
    lcm.subscribeFunction(ChannelPattern(lcm_.prefix + "MOCAP_SILHOUETTE"),
                          &Pass<&NodeListener::OnSilhouette>, this)
        ->setQueueCapacity(kMostWaiting);
    lcm.subscribeFunction(ChannelPattern(lcm_.prefix + "MOCAP_NODE"), &Pass<&NodeListener::OnNode>,
                          this);
  };
  const auto hears = [this] {
    LookRound();
    return SteadyNs() - heard_ns_ < NodeRecord::kSilenceNs;
  };
  listener_.emplace("nodes", lcm_.url, kReopen, LcmListener::Calls{subscribe, hears});
}

std::unique_ptr<SilhouetteSource> NodeListener::Open(const CameraCalibration& camera, int rays) {
  for (Node& node : nodes_) {
    if (Camera* const found = FindCamera(node, camera.name))
      return std::make_unique<RemoteCamera>(found->inbox, rays);
  }
  throw SetupError("camera " + camera.name + " does not belong to a node");
}

NodesReport NodeListener::Report() {
  const std::int64_t now_ns = SteadyNs();
  const std::scoped_lock lock(mutex_);
  NodesReport report;
  for (const Node& node : nodes_) report.nodes.push_back(node.record.Report(now_ns));
  if (!stranger_.empty() && now_ns - stranger_ns_ < kLatelyNs) report.stranger = stranger_;
  return report;
}

NodeListener::Node* NodeListener::Find(const std::string& name) {
  for (Node& node : nodes_)
    if (node.record.name() == name) return &node;
  return nullptr;
}

NodeListener::Camera* NodeListener::FindCamera(Node& node, const std::string& name) {
  for (Camera& camera : node.cameras)
    if (camera.inbox.calibration.name == name) return &camera;
  return nullptr;
}

void NodeListener::OnSilhouette(std::span<const std::uint8_t> bytes) {
  const std::int64_t time_of_day_ns = time_of_day_();
  const std::optional<silhouette_t> message = DecodeMessage<silhouette_t>(bytes);
  if (!message || !IsSound(*message)) return NoteStranger("somebody");
  Node* const node = Find(message->node);
  Camera* const camera = node ? FindCamera(*node, message->camera) : nullptr;
  if (!camera) return NoteStranger(message->camera + " of node " + message->node);
  heard_ns_ = SteadyNs();
  const std::int64_t missed = CountMissed(*message, *camera);
  const std::scoped_lock lock(mutex_);
  const bool is_usable =
      node->record.Take(*message, missed, time_of_day_ns - message->sent_ns, heard_ns_);
  if (is_usable) Deliver(*message, *camera);
}

/// @return  the number of missing silhouettes before this one.
std::int64_t NodeListener::CountMissed(const silhouette_t& message, Camera& camera) {
  const bool is_first = std::exchange(camera.session, message.session) != message.session;
  const std::int64_t missed = is_first ? 0 : message.number - camera.next_number;
  camera.next_number = message.number + 1;
  return std::max<std::int64_t>(missed, 0);
}

void NodeListener::Deliver(const silhouette_t& message, Camera& camera) {
  const CameraCalibration& calibration = camera.inbox.calibration;
  if (message.width_px != calibration.width_px || message.height_px != calibration.height_px)
    return;
  ReceivedSilhouette& received = camera.inbox.queue.back();
  received.packed.assign(message.packed.begin(), message.packed.end());
  received.angles = {message.pan_rad, message.tilt_rad};
  received.capture_ns = message.capture_ns - TheHostClock().OffsetNs();
  received.arrival_ns = TimelineNs();
  received.segment_ns = message.segment_ns;
  received.sequence = static_cast<std::uint64_t>(message.sequence);
  received.is_blind = message.is_blind;
  received.light = message.light;
  received.nudged_px = message.nudged_px;
  camera.inbox.is_connected.store(true, std::memory_order_relaxed);
  camera.inbox.queue.Push();
}

void NodeListener::OnNode(std::span<const std::uint8_t> bytes) {
  const std::int64_t time_of_day_ns = time_of_day_();
  const std::optional<node_t> message = DecodeMessage<node_t>(bytes);
  if (!message || !IsTime(message->sent_ns)) return NoteStranger("somebody");
  Node* const node = Find(message->name);
  if (!node) return NoteStranger("node " + message->name);
  heard_ns_ = SteadyNs();
  const std::scoped_lock lock(mutex_);
  node->record.Take(*message, time_of_day_ns - message->sent_ns, heard_ns_);
}

void NodeListener::LookRound() {
  const std::int64_t now_ns = SteadyNs();
  const std::scoped_lock lock(mutex_);
  for (Node& node : nodes_) {
    const bool is_connected = node.record.IsConnected(now_ns);
    for (Camera& camera : node.cameras) {
      camera.inbox.is_connected.store(is_connected, std::memory_order_relaxed);
      camera.inbox.bell.Ring();
    }
  }
}

void NodeListener::NoteStranger(const std::string& name) {
  const std::scoped_lock lock(mutex_);
  stranger_ = name.substr(0, kLongestName);
  stranger_ns_ = SteadyNs();
}

}  // namespace mocap

#include "daemon/status/node_diagnostics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "config/lcm_url.h"
#include "daemon/status/diagnostics.h"

namespace mocap {
namespace {

/// A larger share of lost silhouettes has a cause.
constexpr double kMostLost = 0.001;
/// A clock with a larger possible error is not kept well enough.
constexpr double kMostError_ms = 5;
/// A node may complete its part of a take later than the studio by this much.
constexpr std::int64_t kRecordingEnd_ns = 10'000'000'000;

using List = std::vector<std::string>;

std::string RangeHint(const std::string& lcm_url) {
  const LcmUrl address = ParseLcmUrl(lcm_url);
  const bool stays_here = address.provider == LcmProvider::kMulticast && address.hops == 0;
  return stays_here ? "; lcm.url has ttl=0, LCM's default, which keeps messages on this computer"
                    : "";
}

std::string Silence(const NodeReport& node, const std::string& lcm_url) {
  const std::string since =
      node.was_heard ? " for " + Duration(node.silent_ns) : " since the start";
  return fmt::format(
      "nothing has been received from node {}{}: check its power and network, and mocapd there{}",
      node.name, since, RangeHint(lcm_url));
}

void DiagnoseClock(const NodeReport& node, List& list) {
  if (!node.clock_agrees) {
    const double apart_ms = static_cast<double>(node.clock_apart_ns) / 1e6;
    list.push_back(
        fmt::format("the clock of node {} is {:.0f} ms {} the clock of this computer, and its "
                    "cameras are not used: synchronize both by ptp4l and phc2sys, or by chrony",
                    node.name, std::abs(apart_ms), apart_ms > 0 ? "behind" : "ahead of"));
  } else if (!node.version.empty() && !node.has_this_clock &&
             (!node.clock_is_kept || node.clock_error_ms > kMostError_ms)) {
    list.push_back(node.clock_is_kept
                       ? fmt::format("the clock of node {} may be off by {:.0f} ms, as its kernel "
                                     "reports: ptp4l and phc2sys are more precise{}",
                                     node.name, node.clock_error_ms,
                                     node.clock_keeper.empty() ? "" : " than " + node.clock_keeper)
                       : fmt::format("nothing synchronizes the clock of node {}: run ptp4l and "
                                     "phc2sys, or chrony, there",
                                     node.name));
  }
}

void Diagnose(const NodeReport& node, const std::string& lcm_url, List& list) {
  if (IsSilent(node)) {
    list.push_back(Silence(node, lcm_url));
    return;
  }
  DiagnoseClock(node, list);
  if (!node.is_of_this_version) {
    list.push_back(
        fmt::format("node {} runs mocapd {}, and this is {}: install one version on both",
                    node.name, node.version, MOCAP_VERSION));
  }
  if (!node.missing.empty()) {
    list.push_back(fmt::format("node {} does not have {}: check its [[cameras]]", node.name,
                               fmt::join(node.missing, ", ")));
  }
  if (!node.miscalibrated.empty()) {
    list.push_back(fmt::format(
        "node {} has a different calibration of {}: copy the studio's calibration.toml to it",
        node.name, fmt::join(node.miscalibrated, ", ")));
  }
  if (node.lost_share > kMostLost) {
    list.push_back(
        fmt::format("{:.1f} % of the silhouettes of node {} are lost on the way: check the "
                    "network, and the socket buffers with mocap doctor",
                    100 * node.lost_share, node.name));
  }
  for (const std::string& complaint : node.complaints) {
    list.push_back(fmt::format("node {}: {}", node.name, complaint));
  }
}

/// Of what the studio hears of the node.
List ReceptionDiagnostics(const StudioLink& link, const std::vector<CameraStatus>& cameras,
                          const std::string& lcm_url) {
  if (link.silent_ns > kLongestSilence_ns) {
    return {fmt::format(
        "no studio has been heard on {} for {}: nobody receives the silhouettes; start mocapd at "
        "the studio with role = \"studio\" and the same lcm.url and lcm.prefix{}",
        lcm_url, Duration(link.silent_ns), RangeHint(lcm_url))};
  }
  List lost;
  for (const CameraStatus& camera : cameras) {
    const bool is_lost = std::ranges::count(link.unreceived, camera.name) > 0;
    if (is_lost && camera.state == CameraState::kStreaming) lost.push_back(camera.name);
  }
  if (lost.empty()) return {};
  return {fmt::format(
      "the studio does not receive {}: check that its [[nodes]] list them, its status, and the "
      "network{}",
      fmt::join(lost, ", "), RangeHint(lcm_url))};
}

}  // namespace

List LinkDiagnostics(const StudioLink& link, const std::vector<CameraStatus>& cameras,
                     const RecordingStatus& recording, const std::string& lcm_url) {
  List list = ReceptionDiagnostics(link, cameras, lcm_url);
  const std::int64_t alone_ns = std::min(link.unrecorded_ns, recording.duration_ns);
  if (recording.state == RecordingStatus::State::kRunning && alone_ns > kRecordingEnd_ns) {
    list.push_back(
        fmt::format("the take {} is being recorded without the studio: end it with mocap record "
                    "stop",
                    recording.folder.stem().string()));
  }
  return list;
}

bool IsOfLostNode(const NodesReport& report, const std::string& node) {
  for (const NodeReport& known : report.nodes)
    if (known.name == node) return IsSilent(known) || !known.clock_agrees;
  return false;
}

List NodeDiagnostics(const NodesReport& report, const std::string& lcm_url) {
  List list;
  for (const NodeReport& node : report.nodes) Diagnose(node, lcm_url, list);
  if (!report.stranger.empty()) {
    list.push_back(
        fmt::format("{} also sends to {} and is not in [[nodes]]: add it, or give that studio "
                    "another lcm.prefix",
                    report.stranger, lcm_url));
  }
  return list;
}

}  // namespace mocap

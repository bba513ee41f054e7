#include "daemon/status/camera_diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "daemon/status/node_diagnostics.h"
#include "drivers/nearest_name.h"

namespace mocap {
namespace {

/// A camera that delivers less than this share of its frames is reported.
constexpr double kGoodRate = 0.9;
/// The tripod was touched.
constexpr double kNudged_px = 0.75;
/// Beyond this, colours no longer match the background.
constexpr double kDarkest = 0.6, kBrightest = 1.5;

/// Where simulated people were unknown to this share, errors were several times as large:
/// docs/contrast.md has the table.
constexpr double kMostUnknown = 0.1;
/// Likewise. Silhouettes of real people before good cameras miss up to 6 %.
constexpr double kMostMissed = 0.1;

using Lines = std::vector<std::string>;

/// Cameras with one fault, and the range of the numbers that show it.
struct Group {
  std::vector<std::string> names;
  double least = 0, most = 0;

  void Add(const std::string& name, double value = 0) {
    least = names.empty() ? value : std::min(least, value);
    most = names.empty() ? value : std::max(most, value);
    names.push_back(name);
  }
  /// "12.1", "12.1 to 12.4".
  std::string Range(int decimals) const {
    const std::string low = fmt::format("{:.{}f}", least, decimals);
    const std::string high = fmt::format("{:.{}f}", most, decimals);
    return low == high ? low : low + " to " + high;
  }
};

/// Expected frame rate of a camera.
double FpsOf(const ServiceReport& report, std::size_t camera) {
  const bool has_its_own = camera < report.camera_fps.size() && report.camera_fps[camera] > 0;
  return has_its_own ? report.camera_fps[camera] : report.fps_nominal;
}

void ComplainOfLoss(const Group& lost, const Group& silent, std::size_t all, Lines& lines) {
  if (!lost.names.empty()) {
    lines.push_back(CamerasDo(lost.names, all, "is lost: check its cable and power",
                              "are lost: check their cables and power"));
  }
  if (!silent.names.empty()) {
    lines.push_back(CamerasDo(silent.names, all, "has not delivered a frame yet",
                              "have not delivered a frame yet"));
  }
}

void ComplainOfFlow(const ServiceReport& report, Lines& lines) {
  const auto& cameras = report.now.status.cameras;
  Group lost, silent;
  std::map<double, Group> slow;  // By the expected rate.
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const CameraStatus& camera = cameras[i];
    if (WaitsForTrigger(report, i) || IsOfLostNode(report.nodes, camera.node)) continue;
    if (camera.state == CameraState::kLost) lost.Add(camera.name);
    if (camera.state == CameraState::kStarting) silent.Add(camera.name);
    const bool returns = i < report.now.returns.size() && report.now.returns[i];
    const bool is_flowing = report.now.sets_per_second > 0 && !returns;
    if (camera.state == CameraState::kStreaming && is_flowing && !HasGoodRate(report, i))
      slow[FpsOf(report, i)].Add(camera.name, report.now.frames_per_second[i]);
  }
  ComplainOfLoss(lost, silent, cameras.size(), lines);
  for (const auto& [fps, group] : slow) {
    const std::string rate =
        fmt::format(" {} of {:.1f} frames a second: check ", group.Range(1), fps);
    lines.push_back(CamerasDo(
        group.names, cameras.size(),
        "delivers" + rate + "its exposure time, its bus or network, and the processor's load",
        "deliver" + rate + "the processor's load, their exposure time, and their bus or network"));
  }
}

void ComplainOfPictures(const std::vector<CameraStatus>& cameras, Lines& lines) {
  Group blind, light;
  for (const CameraStatus& camera : cameras) {
    if (camera.state != CameraState::kStreaming) continue;
    if (camera.is_blind) {
      blind.Add(camera.name);
    } else if (camera.light < kDarkest || camera.light > kBrightest) {
      light.Add(camera.name, 100 * camera.light);
    }
  }
  if (!blind.names.empty()) {
    const std::string remedy =
        "turned, is blocked, has a light shining into it, or has another exposure; if not, run "
        "mocap background learn";
    lines.push_back(CamerasDo(
        blind.names, cameras.size(),
        "no longer matches its background and is not used: check whether it was " + remedy,
        "no longer match their backgrounds and are not used: check whether each was " + remedy));
  }
  if (!light.names.empty()) {
    const bool is_one = light.names.size() == 1;
    lines.push_back(
        fmt::format("the {} {} {} % of the brightness of {}: restore the light, or run "
                    "mocap background learn",
                    is_one ? "picture of" : "pictures of",
                    CamerasDo(light.names, cameras.size(), "has", "have"), light.Range(0),
                    is_one ? "its background" : "their backgrounds"));
  }
}

/// Mounts are touched one by one.
void ComplainOfMounts(const std::vector<CameraStatus>& cameras, Lines& lines) {
  for (const CameraStatus& camera : cameras) {
    const bool is_compared = camera.state == CameraState::kStreaming && !camera.is_blind;
    if (!is_compared || camera.nudged_px <= kNudged_px) continue;
    lines.push_back(
        fmt::format("{} has moved by {:.1f} px since its background was learned: check its mount",
                    camera.name, camera.nudged_px));
  }
}

/// Stays while nobody is there: who has walked in goes to look.
void ComplainOfContrast(const std::vector<CameraStatus>& cameras, Lines& lines) {
  Group alike, missing;
  for (const CameraStatus& camera : cameras) {
    if (camera.state != CameraState::kStreaming) continue;
    const double unknown = camera.health.unknown_share.value_or(0);
    const double missed = camera.health.miss_rate.value_or(0);
    if (unknown >= kMostUnknown) alike.Add(camera.name, 100 * unknown);
    if (missed >= kMostMissed) missing.Add(camera.name, 100 * missed);
  }
  if (!alike.names.empty()) {
    const std::string rest = fmt::format(
        " tell {} % of the people from what is behind them: clothes look like the wall or the "
        "floor; wear others, or change the light",
        alike.Range(0));
    lines.push_back(CamerasDo(alike.names, cameras.size(), "cannot" + rest, "cannot" + rest));
  }
  if (!missing.names.empty()) {
    const std::string rest = fmt::format(
        " {} % of the people whom the others show: clean the lens, learn the background again, or "
        "wear other clothes",
        missing.Range(0));
    lines.push_back(CamerasDo(missing.names, cameras.size(), "misses" + rest, "miss" + rest));
  }
}

}  // namespace

std::vector<std::string> CameraDiagnostics(const ServiceReport& report) {
  Lines lines;
  ComplainOfFlow(report, lines);
  ComplainOfPictures(report.now.status.cameras, lines);
  ComplainOfMounts(report.now.status.cameras, lines);
  ComplainOfContrast(report.now.status.cameras, lines);
  return lines;
}

std::string CamerasDo(const std::vector<std::string>& names, std::size_t all,
                      std::string_view one_does, std::string_view several_do) {
  if (names.size() == 1) return names.front() + ' ' + std::string(one_does);
  const std::string who = names.size() == all && all > 2 ? "all " + std::to_string(all) + " cameras"
                                                         : ListedNames(names);
  return who + ' ' + std::string(several_do);
}

bool WaitsForTrigger(const ServiceReport& report, std::size_t camera) {
  const CameraStatus& status = report.now.status.cameras[camera];
  return !status.waits_for.empty() && status.state != CameraState::kLost &&
         report.now.frames_per_second[camera] == 0;
}

bool HasGoodRate(const ServiceReport& report, std::size_t camera) {
  return report.now.frames_per_second[camera] >= kGoodRate * FpsOf(report, camera);
}

}  // namespace mocap

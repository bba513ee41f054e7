#include "tools/view/status_json.h"

#include <array>
#include <string_view>

#include "core/motion_capture.h"
#include "tools/page/json_text.h"

namespace mocap {
namespace {

constexpr std::array<std::string_view, 4> kCameraStates = {"starting", "streaming", "lost",
                                                           "ended"};
constexpr std::array<std::string_view, 4> kRecordingStates = {"none", "running", "complete",
                                                              "failed"};

/// A number in a message may have no name.
template <std::size_t N>
std::string_view NameOf(const std::array<std::string_view, N>& names, int number) {
  return number >= 0 && number < static_cast<int>(N) ? names[static_cast<std::size_t>(number)]
                                                     : "unknown";
}

Json CameraJson(const camera_status_t& camera, std::size_t place,
                const std::optional<service_t>& service) {
  Json json{{"name", camera.name},
            {"state", NameOf(kCameraStates, camera.state)},
            {"frames_per_second", camera.frames_per_second},
            {"frames", camera.frames},
            {"dropped", camera.dropped},
            {"late", camera.late},
            {"torn", camera.torn},
            {"trust", nullptr},
            {"off_px", nullptr},
            {"light", nullptr}};
  if (!service || place >= service->camera_trust.size()) return json;
  json["light"] = service->camera_light[place];
  if (service->camera_trust[place] < 0) return json;
  json["trust"] = service->camera_trust[place];
  json["off_px"] = service->camera_off_px[place];
  return json;
}

}  // namespace

std::string StatusJson(const status_t& status, const std::optional<service_t>& service) {
  Json json{{"type", "status"},
            {"state", NameOf(kCaptureStateNames, status.state)},
            {"sets_per_second", status.sets_per_second},
            {"sets_complete", status.sets_complete},
            {"sets_partial", status.sets_partial},
            {"sets_dropped", status.sets_dropped},
            {"spread_p50_ms", status.spread_p50_ms},
            {"spread_p99_ms", status.spread_p99_ms},
            {"cameras", Json::array()},
            {"stages", Json::array()}};
  for (std::size_t i = 0; i < status.cameras.size(); ++i) {
    json["cameras"].push_back(CameraJson(status.cameras[i], i, service));
  }
  for (const stage_timing_t& stage : status.stages) {
    json["stages"].push_back({{"name", stage.name},
                              {"count", stage.count},
                              {"p50_ms", stage.p50_ms},
                              {"p99_ms", stage.p99_ms},
                              {"max_ms", stage.max_ms}});
  }
  return JsonText(json);
}

std::string ServiceJson(const service_t& service) {
  return JsonText({{"type", "service"},
                   {"version", service.version},
                   {"studio", service.studio},
                   {"up_seconds", service.up_seconds},
                   {"fps_nominal", service.fps_nominal},
                   {"complaints", service.complaint},
                   {"calibration", service.calibration},
                   {"calibration_made_s", service.calibration_made_s},
                   {"background", service.background},
                   {"background_made_s", service.background_made_s},
                   {"bytes_free", service.bytes_free},
                   {"recording",
                    {{"state", NameOf(kRecordingStates, service.recording_state)},
                     {"folder", service.recording_folder},
                     {"seconds", service.recording_seconds},
                     {"frames", service.recording_frames},
                     {"dropped", service.recording_dropped}}}});
}

}  // namespace mocap

#include "tools/import/import_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

constexpr const char* kRoomNames[] = {"clip", "stretch", "itself"};

/// Offset of a video from the first one's, so that its times become those of the first one.
double OffsetOf(const ImportedTake& take, const ImportedCamera& camera) {
  const ImportedCamera& first = take.cameras.front();
  return camera.clock.TimeOf(0) - first.clock.TimeOf(0);
}

std::string RoomText(const RoomRecord& room) {
  switch (room.source) {
    case RoomSource::kClip:
      return fmt::format("from a clip ({} pictures)", room.pictures);
    case RoomSource::kStretch:
      return fmt::format("from {:.1f} to {:.1f} s, when nobody was there", room.from_s, room.to_s);
    case RoomSource::kItself:
      break;
  }
  std::string text = fmt::format("behind the people ({} pictures)", room.pictures);
  if (room.unseen > 0)
    text += fmt::format("; {:.1f} % of the picture shows nothing but people", 100 * room.unseen);
  return text;
}

/// What to do about it, one line each.
std::vector<std::string> DoubtsOf(const ImportedCamera& camera) {
  std::vector<std::string> doubts;
  const LightRange& light = camera.room.light;
  if (!light.IsExposureFixed())
    doubts.push_back(
        fmt::format("its brightness changes by {:.0f} %: fix exposure and gain, and "
                    "switch HDR off",
                    100 * light.BrightnessChange()));
  if (!light.IsWhiteFixed())
    doubts.push_back(
        fmt::format("its colours change by {:.0f} % (red over blue): fix the white "
                    "balance",
                    100 * light.ColorChange()));
  return doubts;
}

std::string CameraLine(const ImportedTake& take, const ImportedCamera& camera) {
  const ClockFit& fit = camera.clock.fit;
  std::string text =
      fmt::format("{}: {}, {} frames at {:.2f} Hz{}, offset {:+.4f} s by {}",
                  camera.calibration.name, camera.file.filename().string(), camera.times_ns.size(),
                  camera.rate_hz, camera.has_variable_rate ? " (variable)" : "",
                  OffsetOf(take, camera), kSyncNames[static_cast<int>(camera.clock.method)]);
  if (fit.sigma_s > 0) text += fmt::format(" (±{:.1f} ms)", 1000 * fit.sigma_s);
  if (fit.rate_ppm != 0) text += fmt::format(", clock {:+.1f} ppm", fit.rate_ppm);
  if (!camera.turn.empty()) text += ", " + camera.turn;
  return text + "; empty room " + RoomText(camera.room);
}

Json LightJson(const LightRange& light) {
  Json json = Json::object();
  json["exposure_fixed"] = light.IsExposureFixed();
  json["white_balance_fixed"] = light.IsWhiteFixed();
  json["brightness_change"] = Rounded(light.BrightnessChange(), 4);
  json["color_change"] = Rounded(light.ColorChange(), 4);
  return json;
}

Json RoomJson(const RoomRecord& room) {
  Json json = Json::object();
  json["source"] = kRoomNames[static_cast<int>(room.source)];
  json["pictures"] = room.pictures;
  json["unseen"] = Rounded(room.unseen, 4);
  if (room.source == RoomSource::kStretch) {
    json["from_s"] = Rounded(room.from_s, 3);
    json["to_s"] = Rounded(room.to_s, 3);
  }
  return json;
}

Json CameraJson(const ImportedTake& take, const ImportedCamera& camera) {
  const ClockFit& fit = camera.clock.fit;
  Json json = Json::object();
  json["camera"] = camera.calibration.name;
  json["video"] = camera.file.string();
  json["offset_s"] = Rounded(OffsetOf(take, camera), 6);
  json["method"] = kSyncNames[static_cast<int>(camera.clock.method)];
  json["sigma_s"] = Rounded(fit.sigma_s, 6);
  json["confidence"] = Rounded(1 - 1 / std::max(fit.clearness, 1.0), 3);
  json["clearness"] = Rounded(fit.clearness, 2);
  json["disagreement_s"] = Rounded(fit.worst_s, 6);
  json["drift_ppm"] = Rounded(fit.rate_ppm, 2);
  json["first_timestamp_ns"] = camera.times_ns.front();
  json["frames"] = camera.times_ns.size();
  json["rate_hz"] = Rounded(camera.rate_hz, 3);
  json["variable_rate"] = camera.has_variable_rate;
  json["size_px"] = {camera.calibration.width_px, camera.calibration.height_px};
  json["turned"] = camera.turn;
  json["apart_ms"] = Rounded(camera.apart_ms, 2);
  json["most_apart_ms"] = Rounded(camera.most_apart_ms, 2);
  json["background"] = RoomJson(camera.room);
  json["light"] = LightJson(camera.room.light);
  json["doubts"] = DoubtsOf(camera);
  return json;
}

double MostApart(const ImportedTake& take) {
  double most_ms = 0;
  for (const ImportedCamera& camera : take.cameras)
    most_ms = std::max(most_ms, camera.most_apart_ms);
  return most_ms;
}

}  // namespace

std::string ImportText(const ImportedTake& take) {
  std::string text;
  for (const ImportedCamera& camera : take.cameras) {
    text += CameraLine(take, camera) + '\n';
    for (const std::string& doubt : DoubtsOf(camera))
      text += "  " + camera.calibration.name + ": " + doubt + '\n';
  }
  return text + fmt::format(
                    "{} cameras, {:.1f} s with all of them; pictures of one moment lie up "
                    "to {:.1f} ms apart\n",
                    take.cameras.size(), take.common_s, MostApart(take));
}

Json ImportJson(const ImportedTake& take) {
  Json json = Json::object();
  json["cameras"] = Json::array();
  for (const ImportedCamera& camera : take.cameras)
    json["cameras"].push_back(CameraJson(take, camera));
  json["common_s"] = Rounded(take.common_s, 3);
  json["most_apart_ms"] = Rounded(MostApart(take), 2);
  json["remarks"] = take.remarks;
  return json;
}

}  // namespace mocap

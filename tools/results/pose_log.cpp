#include "tools/results/pose_log.h"

#include <algorithm>
#include <lcm/lcm-cpp.hpp>
#include <optional>
#include <string_view>

#include "config/body_size_fields.h"
#include "core/errors.h"
#include "daemon/messages/decode_message.h"

namespace mocap {
namespace {

template <typename Message>
Message Decode(const std::filesystem::path& log, const lcm::LogEvent& event) {
  std::optional<Message> message = DecodeMessage<Message>(
      {static_cast<const std::uint8_t*>(event.data), static_cast<std::size_t>(event.datalen)});
  if (!message) {
    throw SetupError(log.string() + ": event " + std::to_string(event.eventnum) + ": " +
                     event.channel +
                     " is not a message of this version; a log that lcm-logger "
                     "recorded of this mocapd is wanted");
  }
  return *std::move(message);
}

PoseRow RowOf(const pose_t& message) {
  PoseRow row;
  row.frame = message.frame;
  row.timestamp_ns = message.utime * 1000;
  row.state = static_cast<CaptureState>(std::clamp<int>(message.state, 0, 3));
  row.has_pose = row.state != CaptureState::kSearching;
  row.paper.torso_mm = Vector3(message.torso_mm);
  row.paper.torso_axis = Vector3(message.torso_axis);
  row.paper.torso_angle_rad = message.torso_angle_rad;
  std::copy_n(message.theta_rad, kPaperAngleCount, row.paper.theta_rad.begin());
  for (int i = 0; i < kPointCount; ++i) row.points_W.col(i) = Vector3(message.point_mm[i]);
  row.residual_mm = message.residual_mm;
  row.voxels = message.voxels;
  return row;
}

BodyRecord RecordOf(const body_t& message) {
  BodyRecord body;
  body.model = message.model;
  body.stature_mm = message.stature_mm;
  for (const BodySizeField& field : kBodySizeFields) {
    const auto name = std::ranges::find(message.size_name, field.name);
    if (name == message.size_name.end()) continue;
    body.sizes.*field.value = message.size_mm[name - message.size_name.begin()];
  }
  return body;
}

}  // namespace

Result ReadPoseLog(const std::filesystem::path& log) {
  lcm::LogFile file(log.string(), "r");
  if (!file.good()) throw SetupError(log.string() + ": cannot be read");
  Result result;
  bool has_body = false;
  while (const lcm::LogEvent* event = file.readNextEvent()) {
    const std::string_view channel = event->channel;
    if (channel.ends_with("MOCAP_POSE")) {
      result.poses.push_back(RowOf(Decode<pose_t>(log, *event)));
    } else if (channel.ends_with("MOCAP_BODY")) {
      result.body = RecordOf(Decode<body_t>(log, *event));
      has_body = true;
    }
  }
  if (result.poses.empty() || !has_body) {
    throw SetupError(log.string() + ": holds no " +
                     (result.poses.empty() ? "MOCAP_POSE" : "MOCAP_BODY") +
                     " message, wanted a log that lcm-logger recorded of mocapd");
  }
  return result;
}

}  // namespace mocap

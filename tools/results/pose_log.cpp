#include "tools/results/pose_log.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string_view>

#include "config/body_size_fields.h"
#include "config/joint_names.h"
#include "core/errors.h"
#include "daemon/messages/channel_name.h"
#include "daemon/messages/decode_message.h"
#include "drivers/printable_text.h"
#include "tools/results/channel_log.h"
#include "tools/results/set_details.h"

namespace mocap {
namespace {

/// Larger values are no valid time of day; nanoseconds do not overflow below.
constexpr std::int64_t kLatest_us = 4'000'000'000'000'000;
/// Data of one daemon in a log: of all channels with the same prefix.
struct Daemon {
  std::vector<PoseRow> poses;
  FrameOrder order;
  std::optional<BodyRecord> body;
  SetDetails details;
  std::int64_t repeated = 0;  ///< Duplicate messages.
  bool has_several_people = false;
};

bool IsFinite(const PoseRow& row) {
  double sum = row.paper.torso_mm.sum() + row.paper.torso_axis.sum() + row.paper.torso_angle_rad +
               row.points_W.sum() + row.point_std_mm.sum() + row.joint_rad.sum() + row.residual_mm;
  for (const double theta_rad : row.paper.theta_rad) sum += theta_rad;
  return std::isfinite(sum);
}

bool AddPose(std::span<const std::uint8_t> bytes, Daemon& daemon) {
  const auto pose = DecodeMessage<pose_t>(bytes);
  std::optional<PoseRow> row = pose ? PoseRowOf(*pose) : std::nullopt;
  if (!row) return false;
  ApplyDetails(daemon.details.OfFirst(pose->utime), *row);
  const bool is_again = !daemon.poses.empty() && daemon.poses.back().frame == row->frame &&
                        daemon.poses.back().timestamp_ns == row->timestamp_ns;
  if (is_again) {
    ++daemon.repeated;
    return true;
  }
  daemon.order.Add(row->frame, row->timestamp_ns);
  daemon.poses.push_back(*row);
  return true;
}

bool AddBody(std::span<const std::uint8_t> bytes, Daemon& daemon) {
  const auto body = DecodeMessage<body_t>(bytes);
  std::optional<BodyRecord> record = body ? BodyRecordOf(*body) : std::nullopt;
  if (!record) return false;
  daemon.body = std::move(record);
  return true;
}

void NotePeople(std::span<const std::uint8_t> bytes, Daemon& daemon) {
  const auto set = DecodeMessage<people_t>(bytes);
  if (set && set->num_people > 1) daemon.has_several_people = true;
}

/// Adds a message of one of our channels. @return  false if it is invalid.
bool AddToDaemon(const ChannelLog& channels, Daemon& daemon) {
  if (channels.name() == kPoseChannel) return AddPose(channels.bytes(), daemon);
  if (channels.name() == kBodyChannel) return AddBody(channels.bytes(), daemon);
  if (channels.name() == kDetailsChannel) return daemon.details.Add(channels.bytes());
  NotePeople(channels.bytes(), daemon);
  return true;
}

using Daemons = std::map<std::string, Daemon>;

Daemons ReadDaemons(ChannelLog& channels) {
  Daemons daemons;
  while (channels.Next()) {
    if (!AddToDaemon(channels, daemons[channels.prefix()])) channels.NoteGarbled();
  }
  std::erase_if(daemons, [](const auto& one) { return one.second.poses.empty(); });
  return daemons;
}

void TellOfTimes(const std::filesystem::path& log, const std::vector<PoseRow>& poses,
                 std::vector<std::string>& remarks) {
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (poses[i].timestamp_ns > poses[i - 1].timestamp_ns) continue;
    remarks.push_back(log.string() + ": capture times go back at frame " +
                      std::to_string(poses[i].frame) + ": the clock was set while recording");
    return;
  }
}

/// Names of the joints; none if there is one that no body table may have.
std::vector<JointRecord> JointsOf(const body_t& message) {
  std::vector<JointRecord> joints;
  for (const std::string& name : message.joint_name) {
    const bool is_second = std::ranges::find(joints, name, &JointRecord::name) != joints.end();
    if (is_second || joints.size() == kMaxJoints || !IsJointName(name)) return {};
    joints.push_back({name});
  }
  return joints;
}

}  // namespace

pose_t PoseOf(const people_t& set, const person_t& person) {
  pose_t pose;
  pose.utime = set.utime;
  pose.complete_utime = set.complete_utime;
  pose.publish_utime = set.publish_utime;
  pose.frame = set.frame;
  pose.state = person.state;
  std::ranges::copy(person.torso_mm, pose.torso_mm);
  std::ranges::copy(person.torso_axis, pose.torso_axis);
  pose.torso_angle_rad = person.torso_angle_rad;
  std::ranges::copy(person.theta_rad, pose.theta_rad);
  pose.num_joints = person.num_joints;
  pose.joint_rad = person.joint_rad;
  std::memcpy(pose.point_mm, person.point_mm, sizeof(pose.point_mm));
  std::ranges::copy(person.point_std_mm, pose.point_std_mm);
  pose.residual_mm = person.residual_mm;
  pose.voxels = person.voxels;
  pose.num_cameras = set.num_cameras;
  pose.camera_used = set.camera_used;
  return pose;
}

std::optional<std::int64_t> CaptureNsOf(std::int64_t utime) {
  if (utime < 0 || utime > kLatest_us) return {};
  return utime * 1000;
}

std::optional<PoseRow> PoseRowOf(const pose_t& message) {
  const std::optional<std::int64_t> timestamp_ns = CaptureNsOf(message.utime);
  if (!timestamp_ns) return {};
  PoseRow row;
  row.frame = message.frame;
  row.timestamp_ns = *timestamp_ns;
  row.state = static_cast<CaptureState>(std::clamp<int>(message.state, 0, 3));
  row.has_pose = row.state != CaptureState::kSearching;
  row.paper.torso_mm = Vector3(message.torso_mm);
  row.paper.torso_axis = Vector3(message.torso_axis);
  row.paper.torso_angle_rad = message.torso_angle_rad;
  std::copy_n(message.theta_rad, kPaperAngleCount, row.paper.theta_rad.begin());
  for (int i = 0; i < kPointCount; ++i) row.points_W.col(i) = Vector3(message.point_mm[i]);
  for (int i = 0; i < kPointCount; ++i) row.point_std_mm[i] = message.point_std_mm[i];
  const std::size_t joints = std::min<std::size_t>(kMaxJoints, message.joint_rad.size());
  row.joint_rad = Eigen::Map<const Eigen::VectorXd>(message.joint_rad.data(), joints);
  row.residual_mm = message.residual_mm;
  row.voxels = message.voxels;
  for (std::size_t i = 0; i < std::min<std::size_t>(7, message.camera_used.size()); ++i) {
    row.first_cameras |= static_cast<std::uint8_t>(message.camera_used[i] ? 1 << i : 0);
  }
  if (!IsFinite(row)) return {};
  return row;
}

std::optional<BodyRecord> BodyRecordOf(const body_t& message) {
  BodyRecord body;
  body.model = message.model;
  body.stature_mm = message.stature_mm;
  double sum = body.stature_mm;
  for (const BodySizeField& field : kBodySizeFields) {
    const auto name = std::ranges::find(message.size_name, field.name);
    if (name == message.size_name.end()) continue;
    body.sizes.*field.value = message.size_mm[name - message.size_name.begin()];
    sum += body.sizes.*field.value;
  }
  if (!std::isfinite(sum)) return {};
  body.joints = JointsOf(message);
  return body;
}

void KeepNamedJoints(Result& result) {
  const auto joints = static_cast<Eigen::Index>(result.body.joints.size());
  for (PoseRow& row : result.poses) {
    if (row.joint_rad.size() != joints) row.joint_rad.resize(0);
  }
}

Result ReadPoseLog(const std::filesystem::path& log, const std::optional<std::string>& prefix) {
  ChannelLog channels(log, {kPoseChannel, kBodyChannel, kPeopleChannel, kDetailsChannel}, prefix);
  Daemons daemons = ReadDaemons(channels);
  const std::optional<std::string> name = channels.Choose(daemons, "poses");
  const auto chosen = name ? daemons.find(*name) : daemons.end();
  const bool has_poses = chosen != daemons.end();
  if (!has_poses || !chosen->second.body) {
    throw SetupError(log.string() + ": contains no " + Printable(prefix.value_or("")) +
                     std::string(has_poses ? kBodyChannel : kPoseChannel) +
                     " message of this version" + channels.PrefixesText() +
                     "; expected a log that lcm-logger recorded of mocapd");
  }
  Daemon& daemon = chosen->second;
  daemon.order.RequireOneDaemon(log, chosen->first + std::string(kPoseChannel));
  Result result{*daemon.body, std::move(daemon.poses), channels.Remarks()};
  KeepNamedJoints(result);
  if (daemon.repeated > 0) {
    result.remarks.push_back(log.string() + ": " + Counted(daemon.repeated, "pose") +
                             " appeared twice, counted once");
  }
  if (daemon.has_several_people) {
    result.remarks.push_back(
        log.string() +
        ": several people were tracked at once; this is the one tracked "
        "longest; mocap evaluate and mocap export read all of them with --people");
  }
  TellOfTimes(log, result.poses, result.remarks);
  return result;
}

}  // namespace mocap

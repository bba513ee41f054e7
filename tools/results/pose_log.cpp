#include "tools/results/pose_log.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string_view>

#include "config/body_size_fields.h"
#include "core/errors.h"
#include "daemon/messages/decode_message.h"
#include "daemon/messages/log_reader.h"
#include "drivers/quoted.h"

namespace mocap {
namespace {

constexpr std::string_view kPose = "MOCAP_POSE", kBody = "MOCAP_BODY", kPeople = "MOCAP_PEOPLE";
/// Microseconds that are no time of day any more, long before nanoseconds overflow.
constexpr std::int64_t kLatest_us = 4'000'000'000'000'000;
/// A frame that comes again so soon is another daemon's, not one of a daemon that was restarted.
constexpr std::int64_t kRestart_ns = 1'000'000'000;

/// What a log has of one daemon: of all channels with the same beginning.
struct Daemon {
  std::vector<PoseRow> poses;
  std::optional<BodyRecord> body;
  std::int64_t repeated = 0;  ///< Messages that came twice.
  bool has_several_people = false;
};

bool IsFinite(const PoseRow& row) {
  double sum = row.paper.torso_mm.sum() + row.paper.torso_axis.sum() + row.paper.torso_angle_rad +
               row.points_W.sum() + row.residual_mm;
  for (const double theta_rad : row.paper.theta_rad) sum += theta_rad;
  return std::isfinite(sum);
}

bool AddPose(const LoggedMessage& message, Daemon& daemon) {
  const auto pose = DecodeMessage<pose_t>(message.bytes);
  const std::optional<PoseRow> row = pose ? PoseRowOf(*pose) : std::nullopt;
  if (!row) return false;
  const bool is_again = !daemon.poses.empty() && daemon.poses.back().frame == row->frame &&
                        daemon.poses.back().timestamp_ns == row->timestamp_ns;
  is_again ? void(++daemon.repeated) : daemon.poses.push_back(*row);
  return true;
}

bool AddBody(const LoggedMessage& message, Daemon& daemon) {
  const auto body = DecodeMessage<body_t>(message.bytes);
  std::optional<BodyRecord> record = body ? BodyRecordOf(*body) : std::nullopt;
  if (!record) return false;
  daemon.body = std::move(record);
  return true;
}

void NotePeople(const LoggedMessage& message, Daemon& daemon) {
  const auto set = DecodeMessage<people_t>(message.bytes);
  if (set && set->num_people > 1) daemon.has_several_people = true;
}

using Daemons = std::map<std::string, Daemon>;

/// The one whose prefix was asked for, or the only one. @throws SetupError
Daemons::iterator Choose(const std::filesystem::path& log, const std::optional<std::string>& prefix,
                         Daemons& daemons) {
  if (prefix) return daemons.find(*prefix);
  std::string found, first;
  int count = 0;
  for (const auto& [name, daemon] : daemons) {
    if (daemon.poses.empty()) continue;
    if (count++ == 0) first = name;
    found += (found.empty() ? "" : ", ") + Quoted(name);
  }
  if (count > 1) {
    throw SetupError(log.string() + ": holds poses of several daemons, with the prefixes " + found +
                     "; --prefix with one of them is wanted");
  }
  return count == 1 ? daemons.find(first) : daemons.end();
}

/// Poses of two persons in turns are nobody's motion.
void RequireOneDaemon(const std::filesystem::path& log, const std::string& channel,
                      const std::vector<PoseRow>& poses) {
  std::size_t back = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const std::int64_t step_ns = poses[i].timestamp_ns - poses[i - 1].timestamp_ns;
    const bool is_again = poses[i].frame <= poses[i - 1].frame && step_ns < kRestart_ns;
    if (step_ns <= 0 || is_again) ++back;
  }
  if (back <= 2 + poses.size() / 20) return;
  throw SetupError(log.string() + ": holds poses of several daemons in turns on " +
                   Printable(channel) +
                   "; a log of one is wanted, or a prefix for each (lcm.prefix)");
}

void TellOfTimes(const std::filesystem::path& log, const std::vector<PoseRow>& poses,
                 std::vector<std::string>& remarks) {
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (poses[i].timestamp_ns > poses[i - 1].timestamp_ns) continue;
    remarks.push_back(log.string() + ": capture times go back at frame " +
                      std::to_string(poses[i].frame) + ": the clock was set meanwhile");
    return;
  }
}

/// Passed-over messages.
std::vector<std::string> RemarksOf(const std::filesystem::path& log, const LogReader& reader,
                                   const std::map<std::string, std::int64_t>& garbled) {
  std::vector<std::string> remarks;
  if (reader.damaged_places() > 0) {
    remarks.push_back(log.string() + ": is damaged in " +
                      Counted(reader.damaged_places(), "place") + "; " +
                      Counted(reader.damaged_bytes(), "byte") + " passed over");
  }
  for (const auto& [channel, count] : garbled) {
    remarks.push_back(log.string() + ": " + Counted(count, "message") + " on " +
                      Printable(channel) + " not understood by this version, and left out");
  }
  return remarks;
}

/// What could be asked for instead.
std::string PrefixesText(const std::set<std::string>& prefixes) {
  std::string text;
  for (const std::string& prefix : prefixes) text += (text.empty() ? "" : ", ") + Quoted(prefix);
  return text.empty() ? "" : " (there are channels with the prefixes " + text + ")";
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

std::optional<PoseRow> PoseRowOf(const pose_t& message) {
  if (message.utime < 0 || message.utime > kLatest_us) return {};
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
  return body;
}

Result ReadPoseLog(const std::filesystem::path& log, const std::optional<std::string>& prefix) {
  LogReader reader(log);
  Daemons daemons;
  std::set<std::string> prefixes;
  std::map<std::string, std::int64_t> garbled;
  LoggedMessage message;
  bool is_log = false;
  while (reader.Next(message)) {
    is_log = true;
    std::string_view channel = message.channel;
    if (channel.ends_with(kPeople)) {
      channel.remove_suffix(kPeople.size());
      NotePeople(message, daemons[std::string(channel)]);
      continue;
    }
    const bool is_pose = channel.ends_with(kPose);
    if (!is_pose && !channel.ends_with(kBody)) continue;
    channel.remove_suffix(is_pose ? kPose.size() : kBody.size());
    if (is_pose) prefixes.emplace(channel);
    if (prefix && channel != *prefix) continue;
    Daemon& daemon = daemons[std::string(channel)];
    const bool is_ours = is_pose ? AddPose(message, daemon) : AddBody(message, daemon);
    if (!is_ours) ++garbled[message.channel];
  }
  if (!is_log) {
    const bool is_empty = reader.damaged_bytes() == 0;
    throw SetupError(log.string() + (is_empty ? ": is empty" : ": is no LCM log") +
                     "; one that lcm-logger recorded of mocapd is wanted");
  }
  const auto chosen = Choose(log, prefix, daemons);
  if (chosen == daemons.end() || chosen->second.poses.empty() || !chosen->second.body) {
    const bool has_poses = chosen != daemons.end() && !chosen->second.poses.empty();
    throw SetupError(log.string() + ": holds no " + Printable(prefix.value_or("")) +
                     std::string(has_poses ? kBody : kPose) + " message of this version" +
                     PrefixesText(prefixes) +
                     "; a log that lcm-logger recorded of mocapd is wanted");
  }
  Daemon& daemon = chosen->second;
  RequireOneDaemon(log, chosen->first + std::string(kPose), daemon.poses);
  Result result{*daemon.body, std::move(daemon.poses), RemarksOf(log, reader, garbled)};
  if (daemon.repeated > 0) {
    result.remarks.push_back(log.string() + ": " + Counted(daemon.repeated, "pose") +
                             " came twice, and count once");
  }
  if (daemon.has_several_people) {
    result.remarks.push_back(log.string() +
                             ": several people were followed at once, and this is whoever had been "
                             "for longest; --people takes everybody");
  }
  TellOfTimes(log, result.poses, result.remarks);
  return result;
}

}  // namespace mocap

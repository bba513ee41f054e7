#include "daemon/messages/status_messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>

#include "core/people/people_capture.h"
#include "daemon/pipeline/keypoint_inbox.h"
#include "daemon/status/diagnostics.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

constexpr std::size_t kMostCharacters = 500;

/// Stages in the order of status_t.
constexpr std::array kToldStages = {Stage::kSegment, Stage::kCarve, Stage::kLabel,
                                    Stage::kFilter,  Stage::kTotal, Stage::kLatency,
                                    Stage::kPublish};

double Bounded(double value, double most) {
  return std::isfinite(value) ? std::clamp(value, -most, most) : 0;
}

/// From what is known to a message.
struct ToMessage {
  template <typename Told>
  void operator()(const auto& known, Told& told) const {
    told = static_cast<Told>(known);
  }
  template <typename Told>
  void Seconds(std::int64_t known_ns, Told& told) const {
    told = static_cast<Told>(static_cast<double>(known_ns) / 1e9);
  }
  void Size(const auto& known, auto& told, std::int32_t& count) const {
    told.resize(known.size());
    count = static_cast<std::int32_t>(known.size());
  }
};

/// From a message to what is known.
struct FromMessage {
  template <typename Known>
  void operator()(Known& known, const auto& told) const {
    known = static_cast<Known>(told);
  }
  void operator()(double& known, double told) const { known = Bounded(told, 1e6); }
  template <typename Known>
  void operator()(Known& known, const std::string& told) const {
    known = Shortened(told, kMostCharacters);
  }
  void Seconds(std::int64_t& known_ns, auto told) const {
    known_ns = static_cast<std::int64_t>(1e9 * Bounded(static_cast<double>(told), 9e9));
  }
  void Size(auto& known, const auto& told, std::int32_t) const { known.resize(told.size()); }
};

template <typename Way, typename Camera, typename Message>
void PassCamera(Way way, Camera& camera, Message& message) {
  way(camera.name, message.name);
  way(camera.state, message.state);
  way(camera.frames, message.frames);
  way(camera.dropped, message.dropped);
  way(camera.late, message.late);
  way(camera.torn, message.torn);
}

template <typename Way, typename Timing, typename Message>
void PassTiming(Way way, Timing& timing, Message& message) {
  way(timing.count, message.count);
  way(timing.p50_ms, message.p50_ms);
  way(timing.p99_ms, message.p99_ms);
  way(timing.max_ms, message.max_ms);
}

/// Each field of status_t once, whichever way it goes.
template <typename Way, typename Report, typename Message>
void PassStatus(Way way, Report& report, Message& message) {
  auto& now = report.now;
  way(report.version, message.version);
  way(now.status.state, message.state);
  way(now.status.sets_complete, message.sets_complete);
  way(now.status.sets_partial, message.sets_partial);
  way(now.status.sets_dropped, message.sets_dropped);
  way(now.sets_per_second, message.sets_per_second);
  way(now.recent[Stage::kSpread].p50_ms, message.spread_p50_ms);
  way(now.recent[Stage::kSpread].p99_ms, message.spread_p99_ms);
  way.Size(now.status.cameras, message.cameras, message.num_cameras);
  way.Size(now.frames_per_second, message.cameras, message.num_cameras);
  for (std::size_t i = 0; i < message.cameras.size(); ++i) {
    PassCamera(way, now.status.cameras[i], message.cameras[i]);
    way(now.frames_per_second[i], message.cameras[i].frames_per_second);
  }
  for (auto& told : message.stages) {
    const auto name = std::ranges::find(kStageNames, told.name);
    if (name == kStageNames.end()) continue;
    PassTiming(way, now.recent[static_cast<Stage>(name - kStageNames.begin())], told);
  }
}

/// Likewise of service_t, except its cameras and diagnostics.
template <typename Way, typename Report, typename Message>
void PassService(Way way, Report& report, Message& message) {
  way(report.version, message.version);
  way(report.studio, message.studio);
  way.Seconds(report.up_ns, message.up_seconds);
  way(report.fps_nominal, message.fps_nominal);
  way(report.calibration.where, message.calibration);
  way(report.calibration.made_s, message.calibration_made_s);
  way(report.background.where, message.background);
  way(report.background.made_s, message.background_made_s);
  way(report.bytes_free, message.bytes_free);
  way(report.recording.state, message.recording_state);
  way(report.recording.folder, message.recording_folder);
  way.Seconds(report.recording.duration_ns, message.recording_seconds);
  way(report.recording.frames, message.recording_frames);
  way(report.recording.dropped, message.recording_dropped);
}

/// Likewise of one of the senders in keypoint_senders_t, except why it was refused.
template <typename Way, typename Sender, typename Message>
void PassKeypointSender(Way way, Sender& sender, Message& message, std::size_t i) {
  way(sender.name, message.name[i]);
  way(sender.views_per_second, message.views_per_second[i]);
  way(sender.lag_ms, message.lag_ms[i]);
  way(sender.taken, message.taken[i]);
  way(sender.dropped_points, message.dropped_points[i]);
}

}  // namespace

void FillStatus(const ServiceReport& report, std::int64_t utime, status_t& message) {
  message.utime = utime;
  message.num_stages = kToldStages.size();
  message.stages.resize(kToldStages.size());
  for (std::size_t i = 0; i < kToldStages.size(); ++i)
    message.stages[i].name = kStageNames[static_cast<std::size_t>(kToldStages[i])];
  PassStatus(ToMessage(), report, message);
}

void FillService(const ServiceReport& report, std::int64_t utime, service_t& message) {
  message.utime = utime;
  message.complaint = Diagnostics(report);
  message.num_complaints = static_cast<std::int32_t>(message.complaint.size());
  PassService(ToMessage(), report, message);
  message.camera_trust.clear();
  message.camera_off_px.clear();
  message.camera_light.clear();
  for (const CameraStatus& camera : report.now.status.cameras) {
    message.camera_trust.push_back(IsCompared(camera) ? camera.health.overlap : -1);
    message.camera_off_px.push_back(IsCompared(camera) ? camera.health.shift_px.norm() : 0);
    message.camera_light.push_back(camera.light);
  }
  message.num_cameras = static_cast<std::int32_t>(message.camera_trust.size());
}

void FillContrast(const ServiceReport& report, std::int64_t utime, contrast_t& message) {
  message.utime = utime;
  message.camera.clear();
  message.unknown_share.clear();
  for (const CameraStatus& camera : report.now.status.cameras) {
    message.camera.push_back(camera.name);
    message.unknown_share.push_back(camera.health.unknown_share.value_or(-1));
  }
  message.num_cameras = static_cast<std::int32_t>(message.camera.size());
}

void FillKeypointSenders(const ServiceReport& report, std::int64_t utime,
                         keypoint_senders_t& message) {
  const std::vector<KeypointSender>& senders = report.keypoints.senders;
  message.utime = utime;
  message.num_senders = static_cast<std::int32_t>(senders.size());
  message.name.resize(senders.size());
  for (auto* list : {&message.views_per_second, &message.lag_ms, &message.agreement})
    list->resize(senders.size());
  for (auto* list : {&message.taken, &message.dropped_points}) list->resize(senders.size());
  message.num_reasons = kKeypointRefusalCount;
  message.reason.assign(kKeypointRefusalNames.begin(), kKeypointRefusalNames.end());
  message.refused.resize(senders.size());
  for (std::size_t i = 0; i < senders.size(); ++i) {
    PassKeypointSender(ToMessage(), senders[i], message, i);
    message.agreement[i] = senders[i].agreement.value_or(-1);
    message.refused[i].assign(senders[i].refused.begin(), senders[i].refused.end());
  }
}

void TakeStatus(const status_t& message, ServiceReport& report) {
  PassStatus(FromMessage(), report, message);
}

void TakeService(const service_t& message, ServiceReport& report) {
  const FromMessage way;
  PassService(way, report, message);
  report.told.emplace(message.complaint.size());
  for (std::size_t i = 0; i < message.complaint.size(); ++i)
    way((*report.told)[i], message.complaint[i]);
  std::vector<CameraStatus>& cameras = report.now.status.cameras;
  for (std::size_t i = 0; i < std::min(cameras.size(), message.camera_trust.size()); ++i) {
    way(cameras[i].light, message.camera_light[i]);
    way(cameras[i].health.overlap, message.camera_trust[i]);
    way(cameras[i].health.shift_px.x(), message.camera_off_px[i]);
    cameras[i].health.moments = cameras[i].health.overlap < 0 ? 0 : HealthWatch::kFewestMoments;
  }
}

void TakeKeypointSenders(const keypoint_senders_t& message, ServiceReport& report) {
  std::vector<KeypointSender>& senders = report.keypoints.senders;
  senders.assign(std::min(KeypointInbox::kMostSenders, message.name.size()), {});
  for (std::size_t i = 0; i < senders.size(); ++i) {
    PassKeypointSender(FromMessage(), senders[i], message, i);
    if (message.agreement[i] >= 0) senders[i].agreement = std::min(message.agreement[i], 1.0);
    for (std::size_t j = 0; j < message.reason.size(); ++j) {
      const auto known = std::ranges::find(kKeypointRefusalNames, message.reason[j]);
      if (known == kKeypointRefusalNames.end()) continue;
      senders[i].refused[static_cast<std::size_t>(known - kKeypointRefusalNames.begin())] =
          message.refused[i][j];
    }
  }
}

void TakePeople(const people_t& message, ServiceReport& report) {
  const FromMessage way;
  report.people.resize(std::min<std::size_t>(kMostPeople, message.people.size()));
  for (std::size_t i = 0; i < report.people.size(); ++i) {
    const person_t& told = message.people[i];
    FollowedPerson& person = report.people[i];
    person.id = told.id;
    way(person.name, told.name);
    way(person.state, told.state);
    way(person.residual_mm, told.residual_mm);
    for (int axis = 0; axis < 3; ++axis) way(person.torso_W[axis], told.torso_mm[axis]);
  }
}

}  // namespace mocap

#include "daemon/messages/pose_publisher.h"

#include <algorithm>

#include "daemon/messages/channel_name.h"
#include "drivers/clock.h"
#include "drivers/take/calibration_file.h"

namespace mocap {

PosePublisher::PosePublisher(lcm::LCM& lcm, const LcmConfig& config, int cameras,
                             CaptureTimes times)
    : sender_(lcm, ParseLcmUrl(config.url).provider),
      pose_channel_(config.prefix + kPoseChannel),
      body_channel_(config.prefix + kBodyChannel),
      people_channel_(config.prefix + kPeopleChannel),
      bodies_channel_(config.prefix + kBodiesChannel),
      details_channel_(config.prefix + kDetailsChannel),
      voxels_channel_(config.prefix + "MOCAP_VOXELS"),
      status_channel_(config.prefix + kStatusChannel),
      service_channel_(config.prefix + kServiceChannel),
      contrast_channel_(config.prefix + kContrastChannel),
      keypoint_senders_channel_(config.prefix + kKeypointSendersChannel),
      studio_channel_(config.prefix + "MOCAP_STUDIO"),
      cameras_(cameras),
      times_(times),
      body_pacer_(1),
      voxels_pacer_(config.voxels_hz),
      paced_voxels_hz_(config.voxels_hz),
      voxels_hz_(config.voxels_hz) {}

template <typename Message>
void PosePublisher::Publish(const std::string& channel, const Message& message) {
  sender_.Send(channel, message, bytes_);
  if (!tap_) return;
  tap_->Offer([&](TappedMessage& copy) {
    copy.channel = channel;
    copy.bytes = bytes_;
    copy.utime = TimelineNs() / 1000;
    return true;
  });
}

TrackedSet PosePublisher::InTimeOfDay(const TrackedSet& set) const {
  TrackedSet stamped = set;
  const std::int64_t ahead_ns = TheHostClock().OffsetNs();
  if (times_ == CaptureTimes::kPresent) stamped.capture_ns += ahead_ns;
  stamped.complete_ns += ahead_ns;
  return stamped;
}

void PosePublisher::OnSet(const TrackedSet& timeline_set) {
  const TrackedSet set = InTimeOfDay(timeline_set);
  const std::int64_t now_ns = SteadyNs();
  const bool body_is_due = body_pacer_.IsDue(now_ns);
  // Before the pose, which already has the new sizes.
  if (set.result.body_changed || body_is_due) {
    FillBody(set.body, set.capture_ns / 1000, body_);
    Publish(body_channel_, body_);
  }
  PublishDetails(set);
  FillPose(set, cameras_, pose_);
  pose_.publish_utime = TimeOfDayNs() / 1000;
  Publish(pose_channel_, pose_);
  PublishPeople(set, body_is_due);
  const double voxels_hz = voxels_hz_.load(std::memory_order_relaxed);
  if (voxels_hz != paced_voxels_hz_) {
    paced_voxels_hz_ = voxels_hz;
    voxels_pacer_ = Pacer(voxels_hz);
  }
  if (voxels_pacer_.IsDue(now_ns)) {
    FillVoxels(set, voxels_);
    Publish(voxels_channel_, voxels_);
  }
}

void PosePublisher::PublishDetails(const TrackedSet& set) {
  for (std::size_t place = 0; place < set.people.size(); ++place) {
    FillDetails(set, place, details_);
    Publish(details_channel_, details_);
  }
}

void PosePublisher::PublishPeople(const TrackedSet& set, bool body_is_due) {
  FillPeople(set, cameras_, people_);
  people_.publish_utime = TimeOfDayNs() / 1000;
  Publish(people_channel_, people_);
  for (const PersonView& person : set.people) {
    const bool is_known = std::ranges::find(known_, person.id) != known_.end();
    if (is_known && !person.capture->result().body_changed && !body_is_due) continue;
    person_body_.id = person.id;
    person_body_.name = person.name;
    FillBody(person.capture->body(), set.capture_ns / 1000, person_body_.body);
    Publish(bodies_channel_, person_body_);
  }
  known_.clear();
  for (const PersonView& person : set.people) known_.push_back(person.id);
}

void PosePublisher::PublishStatus(const ServiceReport& report) {
  const std::int64_t utime = TimeOfDayNs() / 1000;
  FillStatus(report, utime, status_);
  if (watch_) watch_->NoteSent(utime);
  sender_.Send(status_channel_, status_, status_bytes_);
  FillService(report, utime, service_);
  sender_.Send(service_channel_, service_, status_bytes_);
  FillContrast(report, utime, contrast_);
  sender_.Send(contrast_channel_, contrast_, status_bytes_);
  FillKeypointSenders(report, utime, keypoint_senders_);
  sender_.Send(keypoint_senders_channel_, keypoint_senders_, status_bytes_);
  if (studio_.calibration.empty()) return;
  studio_.utime = utime;
  sender_.Send(studio_channel_, studio_, status_bytes_);
}

void PosePublisher::Describe(const std::string& studio,
                             std::span<const CameraCalibration> cameras) {
  studio_.name = studio;
  studio_.calibration = CalibrationText("the studio's calibration", cameras);
}

}  // namespace mocap

#include "daemon/nodes/studio_listener.h"

#include <chrono>
#include <utility>

#include "core/motion_capture.h"
#include "daemon/messages/channel_name.h"
#include "daemon/messages/decode_message.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

constexpr std::chrono::seconds kReopenLog{10};
constexpr std::int64_t kSilenceNs = 2'000'000'000;

std::span<const std::uint8_t> BytesOf(const lcm::ReceiveBuffer& buffer) {
  return {static_cast<const std::uint8_t*>(buffer.data), buffer.data_size};
}

void PassPeople(const lcm::ReceiveBuffer* buffer, const std::string&, StudioListener* listener) {
  listener->OnPeople(BytesOf(*buffer));
}

void PassStatus(const lcm::ReceiveBuffer* buffer, const std::string&, StudioListener* listener) {
  listener->OnStatus(BytesOf(*buffer), SteadyNs());
}

void PassService(const lcm::ReceiveBuffer* buffer, const std::string&, StudioListener* listener) {
  listener->OnService(BytesOf(*buffer), SteadyNs());
}

}  // namespace

StudioListener::StudioListener(const LcmConfig& lcm, const std::vector<std::string>& cameras,
                               std::shared_ptr<SubjectPosition> position)
    : lcm_(lcm),
      position_(std::move(position)),
      start_ns_(SteadyNs()),
      heard_people_ns_(start_ns_ - kSilenceNs),
      recorded_ns_(start_ns_) {
  for (const std::string& name : cameras) cameras_.push_back({name, start_ns_});
}

void StudioListener::Listen() {
  const auto subscribe = [this](lcm::LCM& lcm) {
    lcm.subscribeFunction(ChannelPattern(lcm_.prefix + kStatusChannel), &PassStatus, this);
    lcm.subscribeFunction(ChannelPattern(lcm_.prefix + kServiceChannel), &PassService, this);
    if (!position_) return;
    lcm.subscribeFunction(ChannelPattern(lcm_.prefix + kPeopleChannel), &PassPeople, this);
  };
  listener_.emplace("studio", lcm_.url, kReopenLog,
                    LcmListener::Calls{subscribe, [this] { return Hears(); }});
}

void StudioListener::OnPeople(std::span<const std::uint8_t> bytes) {
  const std::optional<people_t> message = DecodeMessage<people_t>(bytes);
  if (!message || !position_) return;
  heard_people_ns_ = SteadyNs();
  Eigen::AlignedBox3d box_W;
  for (const person_t& person : message->people) {
    const Vector3 torso = Eigen::Map<const Vector3>(person.torso_mm);
    const bool is_followed = person.state == static_cast<int>(CaptureState::kTracking);
    if (is_followed && torso.allFinite()) box_W.extend(torso);
  }
  position_->Tell(box_W.isEmpty() ? std::nullopt : std::optional<Vector3>(box_W.center()));
}

void StudioListener::OnStatus(std::span<const std::uint8_t> bytes, std::int64_t now_ns) {
  const std::optional<status_t> message = DecodeMessage<status_t>(bytes);
  if (!message) return;
  const std::lock_guard lock(mutex_);
  // A studio that was started anew has not received anything yet.
  if (!heard_ns_ || now_ns - *heard_ns_ > kLongestSilence_ns) {
    for (Camera& camera : cameras_) camera.received_ns = now_ns;
  }
  heard_ns_ = now_ns;
  for (Camera& camera : cameras_) {
    for (const camera_status_t& known : message->cameras) {
      if (known.name == camera.name && known.state == camera_status_t::STREAMING)
        camera.received_ns = now_ns;
    }
  }
}

void StudioListener::OnService(std::span<const std::uint8_t> bytes, std::int64_t now_ns) {
  const std::optional<service_t> message = DecodeMessage<service_t>(bytes);
  if (!message || message->recording_state != service_t::RUNNING) return;
  const std::lock_guard lock(mutex_);
  recorded_ns_ = now_ns;
}

bool StudioListener::Hears() {
  const std::int64_t now_ns = SteadyNs();
  if (position_ && now_ns - heard_people_ns_ >= kSilenceNs) position_->Tell({});
  const std::lock_guard lock(mutex_);
  return heard_ns_ && now_ns - *heard_ns_ < kSilenceNs;
}

StudioLink StudioListener::Link(std::int64_t now_ns) const {
  const std::lock_guard lock(mutex_);
  StudioLink link;
  link.silent_ns = now_ns - heard_ns_.value_or(start_ns_);
  link.unrecorded_ns = now_ns - recorded_ns_;
  if (link.silent_ns > kLongestSilence_ns) return link;
  for (const Camera& camera : cameras_) {
    if (now_ns - camera.received_ns > kLongestSilence_ns) link.unreceived.push_back(camera.name);
  }
  return link;
}

}  // namespace mocap

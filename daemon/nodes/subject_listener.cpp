#include "daemon/nodes/subject_listener.h"

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

void PassSubject(const lcm::ReceiveBuffer* buffer, const std::string&, SubjectListener* listener) {
  listener->OnPeople({static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
}

}  // namespace

SubjectListener::SubjectListener(const LcmConfig& lcm, std::shared_ptr<SubjectPosition> position)
    : lcm_(lcm), position_(std::move(position)) {}

void SubjectListener::Listen() {
  const auto subscribe = [this](lcm::LCM& lcm) {
    lcm.subscribeFunction(ChannelPattern(lcm_.prefix + kPeopleChannel), &PassSubject, this);
  };
  listener_.emplace("studio", lcm_.url, kReopenLog,
                    LcmListener::Calls{subscribe, [this] { return Hears(); }});
}

void SubjectListener::OnPeople(std::span<const std::uint8_t> bytes) {
  const std::optional<people_t> message = DecodeMessage<people_t>(bytes);
  if (!message) return;
  heard_ns_ = SteadyNs();
  Eigen::AlignedBox3d box_W;
  for (const person_t& person : message->people) {
    const Vector3 torso = Eigen::Map<const Vector3>(person.torso_mm);
    const bool is_followed = person.state == static_cast<int>(CaptureState::kTracking);
    if (is_followed && torso.allFinite()) box_W.extend(torso);
  }
  position_->Tell(box_W.isEmpty() ? std::nullopt : std::optional<Vector3>(box_W.center()));
}

bool SubjectListener::Hears() {
  const bool hears = SteadyNs() - heard_ns_ < kSilenceNs;
  if (!hears) position_->Tell({});
  return hears;
}

}  // namespace mocap

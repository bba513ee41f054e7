#include "tools/stream/pose_feed.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/people/people_capture.h"
#include "daemon/messages/channel_name.h"
#include "daemon/messages/decode_message.h"
#include "daemon/status/followed_person.h"
#include "drivers/clock.h"
#include "drivers/nearest_name.h"
#include "drivers/printable_text.h"
#include "tools/results/message_body.h"
#include "tools/results/pose_log.h"

namespace mocap {
namespace {

std::span<const std::uint8_t> BytesOf(const lcm::ReceiveBuffer& buffer) {
  return {static_cast<const std::uint8_t*>(buffer.data),
          static_cast<std::size_t>(buffer.data_size)};
}

template <typename Message>
std::optional<Message> Decoded(const lcm::ReceiveBuffer& buffer) {
  return DecodeMessage<Message>(BytesOf(buffer));
}

bool IsSound(const pose_t& pose) {
  return PoseRowOf(pose) && pose.num_joints <= kMaxJoints && StateOf(pose).IsFinite();
}

bool IsIn(const people_t& set, int id) {
  return std::ranges::find(set.people, id, &person_t::id) != set.people.end();
}

/// Anyone may send.
std::vector<std::string> LabelsIn(const people_t& set) {
  constexpr std::size_t kMostCharacters = 40;
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < std::min<std::size_t>(kMostPeople, set.people.size()); ++i)
    labels.push_back(LabelOf(set.people[i].id, Shortened(set.people[i].name, kMostCharacters)));
  return labels;
}

/// Message for a person who is absent.
pose_t NoPoseIn(const people_t& set) {
  pose_t pose{};
  pose.utime = set.utime;
  pose.frame = set.frame;
  pose.state = pose_t::SEARCHING;
  return pose;
}

}  // namespace

PoseFeed::PoseFeed(lcm::LCM& lcm, const PoseFeedOptions& options, Take take)
    : options_(options),
      take_(std::move(take)),
      rate_(options.most_hz),
      heard_ns_(SteadyNs()),
      present_ns_(heard_ns_) {
  const std::string prefix = ChannelPattern(options.prefix);
  if (options.everybody || options.person) {
    lcm.subscribe(prefix + kPeopleChannel, &PoseFeed::OnPeople, this);
    lcm.subscribe(prefix + kBodiesChannel, &PoseFeed::OnPersonBody, this);
  } else {
    lcm.subscribe(prefix + kPoseChannel, &PoseFeed::OnPose, this);
    lcm.subscribe(prefix + kBodyChannel, &PoseFeed::OnBody, this);
  }
  lcm.subscribe(prefix + kDetailsChannel, &PoseFeed::OnDetails, this);
}

void PoseFeed::OnPose(const lcm::ReceiveBuffer* buffer, const std::string&) {
  const std::optional<pose_t> pose = Decoded<pose_t>(*buffer);
  if (!pose) return;
  has_heard_ = true;
  present_ns_ = SteadyNs();
  if (IsDue(pose->utime)) HandOn(*pose, 0, "");
}

void PoseFeed::OnPeople(const lcm::ReceiveBuffer* buffer, const std::string&) {
  const std::optional<people_t> set = Decoded<people_t>(*buffer);
  if (!set) return;
  std::erase_if(bodies_, [&](const auto& body) { return !IsIn(*set, body.first); });
  const bool is_present = !options_.person || IsIn(*set, *options_.person);
  has_heard_ = has_heard_ || is_present;
  if (is_present) present_ns_ = SteadyNs();
  if (!set->people.empty()) last_seen_ = LabelsIn(*set);
  if (!IsDue(set->utime)) return;
  for (const person_t& person : set->people) {
    if (options_.person.value_or(person.id) != person.id) continue;
    HandOn(PoseOf(*set, person), person.id, person.name);
  }
  if (!is_present) {
    HandOn(NoPoseIn(*set), *options_.person, "");
  }
}

std::string PoseFeed::LastSeen() const {
  return last_seen_.empty() ? "" : "last seen: " + ListedNames(last_seen_);
}

void PoseFeed::OnBody(const lcm::ReceiveBuffer* buffer, const std::string&) {
  if (std::optional<body_t> body = Decoded<body_t>(*buffer)) bodies_[0] = std::move(*body);
}

void PoseFeed::OnPersonBody(const lcm::ReceiveBuffer* buffer, const std::string&) {
  std::optional<person_body_t> message = Decoded<person_body_t>(*buffer);
  const bool has_room =
      message && (bodies_.contains(message->id) || bodies_.size() < std::size_t{kMostPeople});
  if (has_room) bodies_[message->id] = std::move(message->body);
}

void PoseFeed::OnDetails(const lcm::ReceiveBuffer* buffer, const std::string&) {
  details_.Add(BytesOf(*buffer));
}

bool PoseFeed::IsDue(std::int64_t utime) {
  heard_ns_ = SteadyNs();
  const std::optional<std::int64_t> capture_ns = CaptureNsOf(utime);
  return capture_ns && rate_.Passes(*capture_ns);
}

void PoseFeed::HandOn(const pose_t& pose, int person, const std::string& name) {
  if (pose.state != pose_t::TRACKING) {
    if (CaptureNsOf(pose.utime)) take_({.message = pose, .person = person, .name = name});
    return;
  }
  const auto body = bodies_.find(person);
  if (body == bodies_.end() || body->second.num_joints != pose.num_joints || !IsSound(pose)) return;
  const person_details_t* const details =
      person == 0 ? details_.OfFirst(pose.utime) : details_.Of(pose.utime, person);
  StreamedPose streamed{
      .message = pose, .is_tracked = true, .body = &body->second, .person = person, .name = name};
  ApplyDetails(details, streamed.details);
  take_(streamed);
}

}  // namespace mocap

#include "tools/witness/live_witness.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <mocap/keypoints_t.hpp>
#include <mocap/person_details_t.hpp>
#include <span>
#include <tuple>
#include <utility>

#include "config/lcm_url.h"
#include "core/people/people_capture.h"
#include "daemon/messages/channel_name.h"
#include "daemon/messages/decode_message.h"
#include "daemon/messages/keypoint_message.h"

namespace mocap {
namespace {

constexpr const char* kSender = "mocap witness";
constexpr std::int64_t kRenew_ns = 1'000'000'000;
constexpr double kHold_s = 5;
/// mocapd takes nothing that is older than a second.
constexpr std::int64_t kLateLook_ns = 700'000'000;
/// Who is not shown for longer has left.
constexpr std::int64_t kPersonGone_ns = 3'000'000'000;
/// Below this probability a pose is in doubt.
constexpr double kDoubt = 0.9;
/// Larger pictures are no cuts that were asked for.
constexpr std::int32_t kLargestLook_px = 8192;
/// A region is larger than the body in it by this factor.
constexpr double kLookMargin = 1.25;

std::span<const std::uint8_t> BytesOfMessage(const lcm::ReceiveBuffer& buffer) {
  return {static_cast<const std::uint8_t*>(buffer.data), buffer.data_size};
}

std::int64_t ThreadCpuNs() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

/// Whether a picture's numbers are plausible. Anyone may have sent it.
bool IsPicture(const look_t& look) {
  return look.width_px > 0 && look.width_px <= kLargestLook_px && look.reduction > 0 &&
         look.person >= 0 && std::isfinite(look.up[0]) && std::isfinite(look.up[1]);
}

/// The person in the cut picture.
PictureRegion RegionIn(const look_t& look, double aspect) {
  const double middle_px = (look.width_px - 1) / 2.0, side_px = look.width_px / kLookMargin;
  return RegionAround({.middle_px = {middle_px, middle_px},
                       .width_px = side_px,
                       .height_px = side_px,
                       .turns = TurnsFor({look.up[0], look.up[1]})},
                      aspect);
}

/// From the cut picture to the camera's.
void MoveToCamera(const look_t& look, std::vector<Keypoint>& points) {
  const Vector2 corner_px(look.left_px, look.top_px);
  for (Keypoint& point : points) {
    const Vector2 px =
        corner_px.array() - 0.5 + look.reduction * (point.px.cast<double>().array() + 0.5);
    point.px = px.cast<float>();
  }
}

}  // namespace

LiveWitness::LiveWitness(lcm::LCM& lcm, const LiveWitnessOptions& options, PoseNetwork& network)
    : lcm_(lcm),
      network_(network),
      prefix_(options.prefix),
      sender_(lcm, ParseLcmUrl(options.url).provider),
      pace_(options.rate_hz, options.share) {
  const std::string prefix = ChannelPattern(prefix_);
  subscriptions_ = {lcm.subscribe(prefix + "MOCAP_LOOK", &LiveWitness::OnLook, this),
                    lcm.subscribe(prefix + kDetailsChannel, &LiveWitness::OnDetails, this),
                    lcm.subscribe(prefix + kStatusChannel, &LiveWitness::OnStatus, this)};
}

LiveWitness::~LiveWitness() {
  for (lcm::Subscription* subscription : subscriptions_) lcm_.unsubscribe(subscription);
}

void LiveWitness::OnLook(const lcm::ReceiveBuffer* buffer, const std::string&) {
  std::optional<look_t> look = DecodeMessage<look_t>(BytesOfMessage(*buffer));
  if (!look || !IsPicture(*look)) {
    ++count_.damaged;
    return;
  }
  if (!people_.contains(look->person) && people_.size() >= static_cast<std::size_t>(kMostPeople))
    return;
  Person& person = people_[look->person];
  person.waiting = std::move(look);
  person.came_ns = now_ns_;
}

void LiveWitness::OnDetails(const lcm::ReceiveBuffer* buffer, const std::string&) {
  const auto details = DecodeMessage<person_details_t>(BytesOfMessage(*buffer));
  was_in_doubt_ |= details && details->probability < kDoubt;
}

void LiveWitness::OnStatus(const lcm::ReceiveBuffer*, const std::string&) { has_heard_ = true; }

void LiveWitness::Work(std::int64_t now_ns) {
  now_ns_ = now_ns;
  if (std::exchange(has_heard_, false)) heard_ns_ = now_ns;
  ForgetLate();
  if (!has_asked_ || now_ns - asked_ns_ >= kRenew_ns) {
    Ask(pace_.Rate(static_cast<int>(people_.size()), std::exchange(was_in_doubt_, false)));
    asked_ns_ = now_ns;
    has_asked_ = true;
  }
  Person* person = now_ns < pace_.next_ns() ? nullptr : NextPerson();
  if (person == nullptr) return;
  const std::int64_t cpu_ns = ThreadCpuNs();
  person->looked_ns = now_ns;
  Look(*std::exchange(person->waiting, std::nullopt));
  const std::int64_t cost_ns = ThreadCpuNs() - cpu_ns;
  pace_.Note(now_ns, cost_ns);
  count_.cpu_ns += cost_ns;
}

void LiveWitness::End() { Ask(0); }

void LiveWitness::ForgetLate() {
  for (auto& [number, person] : people_)
    if (now_ns_ - person.came_ns > kLateLook_ns) person.waiting.reset();
  std::erase_if(people_, [this](const auto& entry) {
    return now_ns_ - entry.second.came_ns > kPersonGone_ns;
  });
}

void LiveWitness::Ask(double rate_hz) {
  const NetworkDescription& network = network_.description();
  look_request_t request{};
  request.asker = kSender;
  request.rate_hz = rate_hz;
  request.hold_s = kHold_s;
  // A reduced picture has at least the pixels of the input.
  request.side_px = 2 * std::max(network.width_px, network.height_px);
  request.encoding = look_t::JPEG;
  sender_.Send(prefix_ + "MOCAP_LOOK_REQUEST", request, bytes_);
}

/// Of the newest picture, the person who was not looked at for the longest time.
LiveWitness::Person* LiveWitness::NextPerson() {
  Person* next = nullptr;
  const auto rank = [](const Person& person) {
    return std::tuple(person.waiting->capture_ns, -person.looked_ns);
  };
  for (auto& [number, person] : people_)
    if (person.waiting && (next == nullptr || rank(person) > rank(*next))) next = &person;
  return next;
}

bool LiveWitness::Decode(const look_t& look) {
  const RawPicture raw{
      .format = look.encoding == look_t::BGR ? PixelFormat::kBgr : PixelFormat::kMjpeg,
      .width_px = look.width_px,
      .height_px = look.width_px,
      .bytes = look.picture};
  return converter_.Convert(raw, picture_);
}

void LiveWitness::Look(const look_t& look) {
  if (!Decode(look)) {
    ++count_.damaged;
    return;
  }
  ++count_.looks;
  KeypointView view{
      .camera = look.camera,
      .capture_ns = look.capture_ns,
      .person = look.person,
      .points = network_.Find(picture_.view(), RegionIn(look, network_.description().aspect()))};
  if (view.points.empty()) {
    ++count_.failed;
    return;
  }
  MoveToCamera(look, view.points);
  keypoints_t message;
  message.sender = kSender;
  FillKeypoints(view, message);
  sender_.Send(prefix_ + kKeypointsChannel, message, bytes_);
}

}  // namespace mocap

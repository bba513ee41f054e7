#include "daemon/messages/client_listener.h"

#include <algorithm>
#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <string>
#include <utility>

#include "daemon/messages/channel_name.h"
#include "daemon/messages/decode_message.h"
#include "daemon/messages/keypoint_message.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

/// The daemon's own status comes every second: a connection that hears none is reopened.
constexpr std::chrono::seconds kReopenForClients{10};
constexpr std::int64_t kSilenceOfAll_ns = 4'000'000'000;
/// Maximum queue in LCM while this thread does not run.
constexpr int kMostKeypointsQueued = 256;
constexpr std::size_t kLongestSender = 40;

std::span<const std::uint8_t> BytesIn(const lcm::ReceiveBuffer& buffer) {
  return {static_cast<const std::uint8_t*>(buffer.data), buffer.data_size};
}

void PassKeypoints(const lcm::ReceiveBuffer* buffer, const std::string&, ClientListener* listener) {
  listener->OnKeypoints(BytesIn(*buffer));
}

void PassLookRequest(const lcm::ReceiveBuffer* buffer, const std::string&,
                     ClientListener* listener) {
  listener->OnLookRequest(BytesIn(*buffer));
}

void PassOwnStatus(const lcm::ReceiveBuffer*, const std::string&, ClientListener* listener) {
  listener->OnStatus();
}

}  // namespace

ClientListener::ClientListener(const LcmConfig& config, std::vector<CameraCalibration> cameras,
                               CaptureTimes times, KeypointInbox& inbox, MessageTap& messages,
                               KeypointTap& keypoints, Ask ask)
    : lcm_(config),
      cameras_(std::move(cameras)),
      times_(times),
      inbox_(inbox),
      messages_(messages),
      keypoints_(keypoints),
      ask_(std::move(ask)) {}

void ClientListener::Listen() {
  const LcmProvider provider = ParseLcmUrl(lcm_.url).provider;
  if (provider != LcmProvider::kMulticast && provider != LcmProvider::kTcp) return;
  const auto subscribe = [this](lcm::LCM& lcm) {
    lcm.subscribeFunction(ChannelPattern(lcm_.prefix + kKeypointsChannel), &PassKeypoints, this)
        ->setQueueCapacity(kMostKeypointsQueued);
    lcm.subscribeFunction(ChannelPattern(lcm_.prefix + "MOCAP_LOOK_REQUEST"), &PassLookRequest,
                          this);
    lcm.subscribeFunction(ChannelPattern(lcm_.prefix + kStatusChannel), &PassOwnStatus, this);
  };
  const auto hears = [this] { return SteadyNs() - heard_ns_ < kSilenceOfAll_ns; };
  listener_.emplace("clients", lcm_.url, kReopenForClients, LcmListener::Calls{subscribe, hears});
}

void ClientListener::OnStatus() { heard_ns_ = SteadyNs(); }

void ClientListener::OnKeypoints(std::span<const std::uint8_t> bytes) {
  heard_ns_ = SteadyNs();
  const std::optional<keypoints_t> message = DecodeMessage<keypoints_t>(bytes);
  if (!message) return inbox_.Refuse("", KeypointRefusal::kInvalid, heard_ns_);
  if (!Take(*message)) return;
  messages_.Offer([&](TappedMessage& copy) {
    copy.channel = lcm_.prefix + kKeypointsChannel;
    copy.bytes.assign(bytes.begin(), bytes.end());
    copy.utime = TimelineNs() / 1000;
    return true;
  });
}

void ClientListener::OnLookRequest(std::span<const std::uint8_t> bytes) {
  heard_ns_ = SteadyNs();
  if (const auto request = DecodeMessage<look_request_t>(bytes)) ask_(*request);
}

bool ClientListener::Take(const keypoints_t& message) {
  const std::string sender = Shortened(message.sender, kLongestSender);
  if (!IsSound(message)) {
    inbox_.Refuse(sender, KeypointRefusal::kInvalid, heard_ns_);
    return false;
  }
  const auto camera = std::ranges::find(cameras_, message.camera, &CameraCalibration::name);
  if (camera == cameras_.end()) {
    inbox_.Refuse(sender, KeypointRefusal::kCamera, heard_ns_);
    return false;
  }
  UsableKeypoints usable = UsableOf(message, *camera);
  const bool is_present = times_ == CaptureTimes::kPresent;
  if (is_present) usable.view.capture_ns -= TheHostClock().OffsetNs();
  const std::int64_t now_ns = is_present ? TimelineNs() : inbox_.set_ns();
  if (!inbox_.Add(sender, usable.view, usable.dropped, now_ns, heard_ns_)) return false;
  keypoints_.Offer([&](KeypointView& copy) {
    copy = std::move(usable.view);
    return true;
  });
  return true;
}

}  // namespace mocap

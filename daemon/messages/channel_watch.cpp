#include "daemon/messages/channel_watch.h"

#include <pthread.h>

#include <algorithm>
#include <chrono>

#include "daemon/messages/channel_name.h"
#include "daemon/messages/open_lcm.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

/// Maximum number of statuses in transit.
constexpr std::size_t kRemembered = 64;
/// Statuses come every second.
constexpr std::int64_t kSilenceNs = 4'000'000'000;
constexpr std::int64_t kOtherIsNewsNs = 5'000'000'000;
/// A connection that receives nothing is reopened at this interval.
constexpr std::chrono::seconds kReopen{10};
constexpr std::chrono::milliseconds kTick{100};
constexpr std::int64_t kFirstPauseNs = 1'000'000'000;
constexpr std::int64_t kLongestPauseNs = 60'000'000'000;

/// A status starts with the type's fingerprint, then its time.
std::int64_t TimeIn(const lcm::ReceiveBuffer& message) {
  constexpr std::uint32_t kEnd = 16;
  constexpr std::int64_t kNone = -1;
  if (message.data_size < kEnd) return kNone;
  std::uint64_t utime = 0;
  for (std::uint32_t i = 8; i < kEnd; ++i) {
    utime = utime << 8 | static_cast<const std::uint8_t*>(message.data)[i];
  }
  return static_cast<std::int64_t>(utime);
}

void NoteMessage(const lcm::ReceiveBuffer* message, const std::string& /*channel*/,
                 StatusRegister* heard) {
  heard->NoteHeard(TimeIn(*message), SteadyNs());
}

}  // namespace

void StatusRegister::NoteSent(std::int64_t utime, std::int64_t now_ns) {
  const std::scoped_lock lock(mutex_);
  sent_.push_back(utime);
  if (sent_.size() > kRemembered) sent_.pop_front();
  if (unheard_since_ns_ == kNever) unheard_since_ns_ = now_ns;
}

void StatusRegister::NoteHeard(std::int64_t utime, std::int64_t now_ns) {
  const std::scoped_lock lock(mutex_);
  if (std::ranges::find(sent_, utime) == sent_.end()) {
    other_ns_ = now_ns;
  } else {
    unheard_since_ns_ = kNever;
  }
}

ChannelStatus StatusRegister::Status(std::int64_t now_ns) const {
  const std::scoped_lock lock(mutex_);
  ChannelStatus status;
  status.other_sender = other_ns_ != kNever && now_ns - other_ns_ < kOtherIsNewsNs;
  const std::int64_t silent_ns = unheard_since_ns_ == kNever ? 0 : now_ns - unheard_since_ns_;
  if (silent_ns > kSilenceNs) status.silent_ns = silent_ns;
  return status;
}

ChannelWatch::ChannelWatch(const LcmConfig& config, LcmSender& sender)
    : address_(ParseLcmUrl(config.url)), sender_(sender) {
  if (address_.provider == LcmProvider::kMulticast) {
    listener_.emplace("channel watch", config.url, kReopen,
                      LcmListener::Calls{
                          .subscribe =
                              [this, channel = config.prefix + kStatusChannel](lcm::LCM& lcm) {
                                lcm.subscribeFunction(ChannelPattern(channel), &NoteMessage,
                                                      &register_);
                              },
                          .hears = [this] { return register_.Status(SteadyNs()).silent_ns == 0; }});
  } else if (address_.provider == LcmProvider::kTcp) {
    thread_ = std::thread([this] { AskServer(); });
  }
}

ChannelWatch::~ChannelWatch() {
  stop_.store(true);
  if (thread_.joinable()) thread_.join();
}

void ChannelWatch::NoteSent(std::int64_t utime) { register_.NoteSent(utime, SteadyNs()); }

ChannelStatus ChannelWatch::Status() const {
  ChannelStatus status;
  if (address_.provider == LcmProvider::kMulticast) status = register_.Status(SteadyNs());
  if (listener_) status.receive_fault = listener_->Fault();
  status.reaches_nobody = address_.provider == LcmProvider::kMemory;
  return status;
}

void ChannelWatch::AskServer() {
  pthread_setname_np(pthread_self(), "channel watch");
  std::int64_t pause_ns = kFirstPauseNs;
  std::int64_t tried_ns = SteadyNs();
  for (; !stop_.load(); std::this_thread::sleep_for(kTick)) {
    const std::int64_t since_ns = SteadyNs() - tried_ns;
    if (!sender_.is_down()) {
      if (since_ns > kLongestPauseNs) pause_ns = kFirstPauseNs;
      continue;
    }
    if (since_ns < pause_ns) continue;
    tried_ns = SteadyNs();
    if (!TcpServerAnswers(address_)) continue;
    // A server that answers but accepts no messages is asked ever less often.
    pause_ns = std::min(2 * pause_ns, kLongestPauseNs);
    sender_.TryAgain();
  }
}

}  // namespace mocap

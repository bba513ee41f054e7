#include "daemon/messages/lcm_listener.h"

#include <pthread.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "daemon/messages/open_lcm.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

constexpr int kTickMs = 50;
constexpr std::int64_t kTickNs = kTickMs * 1'000'000;

}  // namespace

LcmListener::LcmListener(std::string name, std::string url, std::chrono::nanoseconds reopen,
                         Calls calls)
    : name_(std::move(name)), url_(std::move(url)), reopen_(reopen), calls_(std::move(calls)) {
  thread_ = std::thread([this] { Run(); });
}

LcmListener::~LcmListener() {
  stop_.store(true);
  thread_.join();
}

std::string LcmListener::Fault() const {
  const std::scoped_lock lock(mutex_);
  return fault_;
}

/// Without a route or a port, LCM would print many lines.
bool LcmListener::CanReceive(const LcmUrl& address) {
  std::string fault = ReceiveFault(address);
  const bool has_port = fault.empty();
  {
    const std::scoped_lock lock(mutex_);
    fault_ = std::move(fault);
  }
  return has_port && (address.provider != LcmProvider::kMulticast || HasMulticastRoute());
}

void LcmListener::Run() {
  pthread_setname_np(pthread_self(), name_.c_str());
  const LcmUrl address = ParseLcmUrl(url_);
  while (!stop_.load()) {
    std::unique_ptr<lcm::LCM> lcm;
    if (CanReceive(address)) lcm = std::make_unique<lcm::LCM>(url_);
    const bool is_open = lcm && lcm->good();
    if (is_open) calls_.subscribe(*lcm);
    std::int64_t heard_ns = SteadyNs(), asked_ns = heard_ns;
    while (!stop_.load() && SteadyNs() - heard_ns < reopen_.count()) {
      if (!is_open || lcm->handleTimeout(kTickMs) < 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(kTickMs));
      if (SteadyNs() - asked_ns < kTickNs) continue;
      asked_ns = SteadyNs();
      if (calls_.hears()) heard_ns = asked_ns;
    }
  }
}

}  // namespace mocap

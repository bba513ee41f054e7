#include "tools/stream/message_source.h"

#include <cerrno>
#include <stdexcept>

#include "config/lcm_url.h"
#include "core/errors.h"
#include "daemon/messages/open_lcm.h"

namespace mocap {
namespace {

LcmUrl AddressOf(const std::string& url) {
  try {
    return ParseLcmUrl(url);
  } catch (const SetupError& error) {
    throw SetupError(std::string("--url: ") + error.what());
  }
}

}  // namespace

MessageSource::MessageSource(const std::string& url) : url_(url) {
  const LcmUrl address = AddressOf(url);
  if (address.provider != LcmProvider::kFile) {
    live_ = OpenLcmToListen(url);
    return;
  }
  if (address.is_written) throw SetupError("--url: " + url + " is a log to write; expected mode=r");
  player_.emplace(address.file, address.speed);
}

bool MessageSource::Handle(std::chrono::milliseconds longest_wait) {
  if (player_) return player_->Play(longest_wait);
  errno = 0;
  // A signal ends the wait, too.
  if (live_->handleTimeout(static_cast<int>(longest_wait.count())) < 0 && errno != EINTR)
    throw std::runtime_error(url_ + ": LCM failed");
  return true;
}

}  // namespace mocap

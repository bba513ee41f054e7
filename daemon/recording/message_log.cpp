#include "daemon/recording/message_log.h"

#include <cstdio>
#include <stdexcept>

namespace mocap {

MessageLog::MessageLog(const std::filesystem::path& file)
    : file_(file), log_(lcm_eventlog_create(file.c_str(), "w")) {
  if (!log_) Fail();
}

void MessageLog::Write(const TappedMessage& message) {
  // The library takes non-const pointers, but only reads.
  lcm_eventlog_event_t event{.eventnum = 0,
                             .timestamp = message.utime,
                             .channellen = static_cast<std::int32_t>(message.channel.size()),
                             .datalen = static_cast<std::int32_t>(message.bytes.size()),
                             .channel = const_cast<char*>(message.channel.c_str()),
                             .data = const_cast<std::uint8_t*>(message.bytes.data())};
  if (lcm_eventlog_write_event(log_.get(), &event) != 0) Fail();
}

void MessageLog::Flush() {
  if (std::fflush(log_->f) != 0) Fail();
}

void MessageLog::Fail() const { throw std::runtime_error(file_.string() + ": cannot be written"); }

}  // namespace mocap

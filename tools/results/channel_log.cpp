#include "tools/results/channel_log.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"
#include "daemon/messages/channel_name.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

/// If a frame number repeats within this time, several daemons send, as a restart takes longer.
constexpr std::int64_t kRestart_ns = 1'000'000'000;

}  // namespace

ChannelLog::ChannelLog(const std::filesystem::path& log, std::vector<std::string_view> names,
                       const std::optional<std::string>& prefix)
    : log_(log.string()), names_(std::move(names)), wanted_prefix_(prefix), reader_(log) {}

bool ChannelLog::Next() {
  while (reader_.Next(message_)) {
    is_log_ = true;
    if (IsWanted()) return true;
  }
  if (!is_log_) FailAsNoLog();
  return false;
}

bool ChannelLog::IsWanted() {
  const std::string_view channel = message_.channel;
  const auto name = std::ranges::find_if(
      names_, [&](const std::string_view one) { return channel.ends_with(one); });
  if (name == names_.end()) return false;
  name_ = *name;
  message_prefix_ = channel.substr(0, channel.size() - name_.size());
  if (name == names_.begin()) prefixes_.insert(message_prefix_);
  return !wanted_prefix_ || message_prefix_ == *wanted_prefix_;
}

void ChannelLog::FailAsNoLog() const {
  const bool is_empty = reader_.damaged_bytes() == 0;
  throw SetupError(log_ + (is_empty ? ": is empty" : ": is not an LCM log") +
                   "; expected one that lcm-logger recorded of mocapd");
}

std::vector<std::string> ChannelLog::Remarks() const {
  std::vector<std::string> remarks;
  if (reader_.damaged_places() > 0) {
    remarks.push_back(log_ + ": is damaged in " + Counted(reader_.damaged_places(), "place") +
                      "; " + Counted(reader_.damaged_bytes(), "byte") + " skipped");
  }
  for (const auto& [channel, count] : garbled_) {
    remarks.push_back(log_ + ": " + Counted(count, "message") + " on " + Printable(channel) +
                      " not understood by this version, skipped");
  }
  return remarks;
}

std::optional<std::string> ChannelLog::ChooseAmong(const std::vector<std::string>& found,
                                                   const std::string& of_what) const {
  if (wanted_prefix_) return wanted_prefix_;
  if (found.empty()) return std::nullopt;
  if (found.size() == 1) return found.front();
  throw SetupError(log_ + ": contains " + of_what + " of several daemons, " + PrefixPhrase(found) +
                   "; choose one of them with --prefix");
}

std::string ChannelLog::PrefixesText() const {
  if (prefixes_.empty()) return "";
  return " (it has channels " + PrefixPhrase({prefixes_.begin(), prefixes_.end()}) + ")";
}

bool FrameOrder::Add(std::int64_t frame, std::int64_t timestamp_ns) {
  const std::int64_t step_ns = timestamp_ns - timestamp_ns_;
  const bool is_again = frames_ > 0 && frame <= frame_;
  const bool is_repeated = is_again && frame == frame_ && step_ns == 0;
  if (is_repeated) return false;
  back_ += frames_ > 0 && (step_ns <= 0 || (is_again && step_ns < kRestart_ns));
  ++frames_;
  frame_ = frame;
  timestamp_ns_ = timestamp_ns;
  // A slightly earlier frame is a message that was overtaken.
  return is_again && (step_ns > 0 || step_ns <= -kRestart_ns);
}

void FrameOrder::RequireOneDaemon(const std::filesystem::path& log,
                                  const std::string& channel) const {
  if (back_ <= 2 + frames_ / 20) return;
  throw SetupError(log.string() + ": contains poses of several daemons in turns on " +
                   Printable(channel) +
                   "; expected a log of one, or a prefix for each (lcm.prefix)");
}

}  // namespace mocap

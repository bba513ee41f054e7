#include "tools/stream.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "config/config.h"
#include "core/errors.h"
#include "daemon/base/number_option.h"
#include "daemon/messages/channel_name.h"
#include "daemon/messages/silence.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"
#include "tools/stop_on_signals.h"
#include "tools/stream/message_source.h"
#include "tools/stream/pose_feed.h"
#include "tools/stream/pose_json.h"
#include "tools/stream/streamed_bones.h"
#include "tools/stream/vmc_sender.h"

namespace mocap {
namespace {

constexpr std::chrono::milliseconds kWait{50};

struct StreamOptions {
  std::string url = LcmConfig().url;
  PoseFeedOptions feed;
  std::string to = "127.0.0.1:39539";
};

/// Prints a message to standard error when a condition becomes true.
class Notice {
 public:
  void Tell(const std::string& text) {
    if (text != told_ && !text.empty()) fmt::print(stderr, "mocap stream: {}\n", Printable(text));
    told_ = text;
  }

 private:
  std::string told_;
};

/// Says that the wanted person is not there, and who is; empty if nobody is, or anybody is wanted.
std::string PersonMissing(const PoseFeedOptions& options, const PoseFeed& feed) {
  const std::string seen = feed.LastSeen();
  if (!options.person || seen.empty()) return "";
  return "person " + std::to_string(*options.person) + " is not tracked; " + seen;
}

std::string NothingHeard(const StreamOptions& options, const PoseFeed& heard) {
  const PoseFeedOptions& feed = options.feed;
  if (const std::string missing = PersonMissing(feed, heard); !missing.empty())
    return options.url + ": " + missing;
  const std::string channel =
      feed.prefix + (feed.everybody || feed.person ? kPeopleChannel : kPoseChannel);
  return options.url + ": has no pose on " + channel +
         "; expected a log of mocapd with this --prefix";
}

/// Streams poses until a signal comes, a log ends, or no reader is left.
/// @param greeting  what to say once the source is open.
/// @throws SetupError  when a log has ended without any.
void Stream(const StreamOptions& options, const PoseFeed::Take& take, const bool& is_over,
            const std::string& greeting = "") {
  StopOnSignals();
  MessageSource source(options.url);
  PoseFeed feed(source.lcm(), options.feed, take);
  const Silence silence(source.lcm(), options.url, options.feed.prefix);
  Notice notice;
  notice.Tell(greeting);
  std::string missing;
  while (!StopAsked() && !is_over && source.Handle(kWait)) {
    if (source.is_log()) continue;
    const std::int64_t now_ns = SteadyNs();
    const bool is_silent = now_ns - feed.heard_ns() > Silence::kLimit_ns;
    const bool is_missing = now_ns - feed.present_ns() > Silence::kLimit_ns;
    // Who else comes and goes is not told anew.
    if (!is_missing)
      missing.clear();
    else if (missing.empty())
      missing = PersonMissing(options.feed, feed);
    notice.Tell(is_silent ? silence.Text() : missing);
  }
  const bool has_ended = !StopAsked() && !is_over;
  if (has_ended && !feed.has_heard()) throw SetupError(NothingHeard(options, feed));
}

/// Writes to standard output at once, even if the reader is slow.
/// @return  false when there is no reader any more, or a signal has come.
bool Print(std::string_view text) {
  while (!text.empty() && !StopAsked()) {
    const ssize_t written = write(STDOUT_FILENO, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EPIPE) {
      return false;
    } else if (errno != EINTR) {
      throw std::runtime_error(std::string("standard output cannot be written: ") +
                               std::strerror(errno));
    }
  }
  return !StopAsked();
}

void StreamJson(const StreamOptions& options) {
  signal(SIGPIPE, SIG_IGN);
  bool is_over = false;
  const auto take = [&is_over](const StreamedPose& pose) {
    is_over = is_over || !Print(PoseJson(pose) + '\n');
  };
  Stream(options, take, is_over);
}

/// Sends poses as an avatar's bones.
class OscStream {
 public:
  explicit OscStream(const std::string& to) : to_(to), sender_(to) {}

  void Take(const StreamedPose& pose) {
    if (!begin_us_) begin_us_ = pose.message.utime;
    const double time_s = 1e-6 * static_cast<double>(pose.message.utime - *begin_us_);
    const auto bones = pose.is_tracked ? bones_.Of(pose) : std::nullopt;
    if (bones) {
      sender_.SendPose(*bones, time_s);
    } else if (!pose.is_tracked) {
      sender_.SendState(static_cast<CaptureState>(pose.message.state), time_s);
    } else {
      unknown_.Tell(
          "the body \"" + Shortened(pose.body->model, 40) +
          "\" is not known here, or its sizes are not those of a person: no bones are sent");
      sender_.SendState(CaptureState::kAcquiring, time_s);
    }
    trouble_.Tell(sender_.trouble().empty() ? "" : to_ + ": " + sender_.trouble());
  }

 private:
  const std::string to_;
  VmcSender sender_;
  Notice unknown_, trouble_;
  StreamedBones bones_;
  std::optional<std::int64_t> begin_us_;
};

void StreamOsc(const StreamOptions& options) {
  OscStream stream(options.to);
  const bool is_over = false;
  Stream(
      options, [&stream](const StreamedPose& pose) { stream.Take(pose); }, is_over,
      "sends to " + options.to + "; Ctrl-C ends it");
}

void AddFeedOptions(CLI::App& command, StreamOptions& options) {
  command.add_option("--url", options.url, "LCM URL; file://LOG plays a log")
      ->capture_default_str();
  command.add_option("--prefix", options.feed.prefix, "prefix of the LCM channel names");
  command.add_option("--rate", options.feed.most_hz, "maximum poses per second (default: all)")
      ->check(NumberFrom(0.01, 1e6));
  command
      .add_option("--person", options.feed.person,
                  "number of the person to stream (default: the one tracked longest)")
      ->check(NumberFrom(1, 1e9));
}

}  // namespace

void AddStreamCommand(CLI::App& app) {
  CLI::App* stream = app.add_subcommand("stream", "Stream live poses to other programs");
  stream->require_subcommand(1);
  const auto options = std::make_shared<StreamOptions>();
  CLI::App* json = stream->add_subcommand("json", "Print each pose as a line of JSON, for pipes");
  AddFeedOptions(*json, *options);
  json->add_flag("--people", options->feed.everybody, "stream all people, one line each")
      ->excludes("--person");
  json->callback([options] { StreamJson(*options); });
  CLI::App* osc = stream->add_subcommand(
      "osc", "Move an avatar by VMC protocol: VSeeFace, Warudo, Unity with EVMC4U, Blender");
  osc->add_option("--to", options->to, "HOST:PORT of the receiving program")->capture_default_str();
  AddFeedOptions(*osc, *options);
  osc->callback([options] { StreamOsc(*options); });
}

}  // namespace mocap

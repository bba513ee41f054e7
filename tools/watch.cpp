#include "tools/watch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <mocap/body_t.hpp>
#include <mocap/pose_t.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/config.h"
#include "daemon/base/number_option.h"
#include "daemon/messages/channel_name.h"
#include "daemon/messages/decode_message.h"
#include "daemon/messages/silence.h"
#include "daemon/messages/status_messages.h"
#include "daemon/status/diagnostics.h"
#include "daemon/status/status_fields.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"
#include "tools/stop_on_signals.h"
#include "tools/stream/message_source.h"

namespace mocap {
namespace {

constexpr std::chrono::milliseconds kWaitForNews{50};
constexpr std::int64_t kPageNs = 250'000'000;
constexpr std::int64_t kLineNs = 1'000'000'000;
/// Time window for rate and latency.
constexpr std::int64_t kWindowNs = 2'000'000'000;

std::span<const std::uint8_t> BytesOf(const lcm::ReceiveBuffer& buffer) {
  return {static_cast<const std::uint8_t*>(buffer.data), buffer.data_size};
}

/// The latest messages.
class Hearing {
 public:
  Hearing(lcm::LCM& lcm, const std::string& named) {
    const std::string prefix = ChannelPattern(named);
    lcm.subscribe(prefix + kPoseChannel, &Hearing::OnPose, this);
    lcm.subscribe(prefix + kBodyChannel, &Hearing::OnBody, this);
    lcm.subscribe(prefix + kPeopleChannel, &Hearing::OnPeople, this);
    lcm.subscribe(prefix + kStatusChannel, &Hearing::OnStatus, this);
    lcm.subscribe(prefix + kServiceChannel, &Hearing::OnService, this);
    lcm.subscribe(prefix + kKeypointSendersChannel, &Hearing::OnKeypointSenders, this);
  }

  /// Removes what is older than the window.
  void Age(std::int64_t now_ns) {
    while (!arrivals_.empty() && now_ns - arrivals_.front().time_ns > kWindowNs) {
      arrivals_.pop_front();
    }
  }
  bool IsSilent(std::int64_t now_ns) const { return now_ns - heard_ns_ > Silence::kLimit_ns; }
  double Rate() const {
    if (arrivals_.size() < 2) return 0;
    const auto span_ns = static_cast<double>(arrivals_.back().time_ns - arrivals_.front().time_ns);
    return span_ns > 0 ? static_cast<double>(arrivals_.size() - 1) * 1e9 / span_ns : 0;
  }
  double LatencyMs() const {
    double sum = 0;
    for (const Arrival& arrival : arrivals_) sum += arrival.latency_ms;
    return arrivals_.empty() ? 0 : sum / static_cast<double>(arrivals_.size());
  }
  std::int64_t missed() const { return missed_; }
  /// Whether poses of several daemons arrive in turns.
  bool HearsSeveral() const { return steps_back_ > 3 + poses_ / 20; }
  const std::optional<pose_t>& pose() const { return pose_; }
  const std::optional<body_t>& body() const { return body_; }
  /// As far as messages tell it.
  const ServiceReport& report() const { return report_; }
  bool HasStatus() const { return has_status_; }

 private:
  struct Arrival {
    std::int64_t time_ns = 0;
    double latency_ms = 0;
  };

  void OnPose(const lcm::ReceiveBuffer* buffer, const std::string&) {
    std::optional<pose_t> pose = Heard<pose_t>(buffer);
    if (!pose) return;
    Count(pose->frame);
    arrivals_.push_back(
        {heard_ns_,
         (static_cast<double>(pose->publish_utime) - static_cast<double>(pose->utime)) / 1000});
    pose_ = std::move(pose);
  }
  /// Counts frames; one daemon's are consecutive. No message content can cause an overflow.
  void Count(std::int64_t frame) {
    constexpr std::int64_t kMostMissed = 1'000'000;
    const std::int64_t before = pose_ ? pose_->frame : frame - 1;
    const bool is_gap = before >= 0 && frame > before;
    if (is_gap && frame - before - 1 < kMostMissed) missed_ += frame - before - 1;
    steps_back_ += pose_ && frame <= before ? 1 : 0;
    ++poses_;
  }

  void OnBody(const lcm::ReceiveBuffer* buffer, const std::string&) {
    std::optional<body_t> body = Heard<body_t>(buffer);
    if (body) body_ = std::move(body);
  }
  void OnPeople(const lcm::ReceiveBuffer* buffer, const std::string&) {
    if (const auto people = Heard<people_t>(buffer)) TakePeople(*people, report_);
  }
  void OnStatus(const lcm::ReceiveBuffer* buffer, const std::string&) {
    const auto status = Heard<status_t>(buffer);
    if (!status) return;
    TakeStatus(*status, report_);
    has_status_ = true;
  }
  void OnService(const lcm::ReceiveBuffer* buffer, const std::string&) {
    if (const auto service = Heard<service_t>(buffer)) TakeService(*service, report_);
  }
  void OnKeypointSenders(const lcm::ReceiveBuffer* buffer, const std::string&) {
    if (const auto senders = Heard<keypoint_senders_t>(buffer))
      TakeKeypointSenders(*senders, report_);
  }
  template <typename Message>
  std::optional<Message> Heard(const lcm::ReceiveBuffer* buffer) {
    std::optional<Message> message = DecodeMessage<Message>(BytesOf(*buffer));
    if (message) heard_ns_ = SteadyNs();
    return message;
  }

  std::int64_t heard_ns_ = SteadyNs();
  std::deque<Arrival> arrivals_;
  std::int64_t missed_ = 0, steps_back_ = 0, poses_ = 0;
  std::optional<pose_t> pose_;
  std::optional<body_t> body_;
  ServiceReport report_;
  bool has_status_ = false;
};

/// Bounds a number from a message, which anyone may have sent.
double Sane(double value) { return std::isfinite(value) ? std::clamp(value, -1e6, 1e6) : 0; }

std::string_view StateName(const pose_t& pose) {
  return NameOf(static_cast<CaptureState>(pose.state));
}

/// "person 1 tracking, person 3 (anna) lost".
std::string PeopleText(const std::vector<FollowedPerson>& people) {
  std::vector<std::string> texts;
  for (const FollowedPerson& person : people)
    texts.push_back(fmt::format("{} {}", LabelOf(person.id, person.name), NameOf(person.state)));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string PoseLine(const Hearing& hearing) {
  const pose_t& pose = *hearing.pose();
  std::string line = fmt::format("{:<9}  {:5.1f} poses/s  latency {:4.0f} ms", StateName(pose),
                                 hearing.Rate(), Sane(hearing.LatencyMs()));
  if (pose.state == pose_t::TRACKING)
    line += fmt::format("  fit {:3.0f} mm", Sane(pose.residual_mm));
  if (hearing.report().people.size() > 1) line += "  " + PeopleText(hearing.report().people);
  line += "  " + Counted(pose.voxels, "voxel");
  if (hearing.HearsSeveral())
    return line + "  poses of several daemons are mixed: give each its own lcm.prefix";
  if (hearing.missed() > 0) line += fmt::format("  {} missed here", hearing.missed());
  return line;
}

/// For a daemon that sends no poses: a node, or a studio without frame sets.
std::string StatusLine(const Hearing& hearing) {
  std::string line = "no poses";
  const ServiceReport& report = hearing.report();
  if (hearing.HasStatus()) {
    line += fmt::format("  {} of {} cameras streaming", Streaming(report.now.status),
                        report.now.status.cameras.size());
  }
  if (report.told && !report.told->empty()) line += "  ! " + report.told->front();
  return line;
}

std::string Line(const Hearing& hearing) {
  return hearing.pose() ? PoseLine(hearing) : StatusLine(hearing);
}

std::string RunningText(const ServiceReport& report) {
  const RecordingStatus& recording = report.recording;
  return fmt::format("recording {}, {}, {} of all cameras, {} dropped, {:.1f} GB free\n",
                     recording.folder.string(), Duration(recording.duration_ns),
                     Counted(recording.frames, "frame"), recording.dropped,
                     static_cast<double>(report.bytes_free) / 1e9);
}

std::string CamerasText(const Hearing& hearing) {
  std::vector<ReportedCamera> cameras = CamerasOf(hearing.report());
  for (std::size_t i = 0; hearing.pose() && i < cameras.size(); ++i) {
    const auto& used = hearing.pose()->camera_used;
    cameras[i].is_used = i < used.size() && used[i];
  }
  return TableOf(CameraFields(), cameras, Shown::kInWatch);
}

std::string Page(const Hearing& hearing, const std::string& url) {
  std::string page = "mocapd";
  if (hearing.HasStatus()) page += ' ' + hearing.report().version;
  page += " on " + Printable(url) + "    Ctrl-C ends\n\n";
  page += Line(hearing) + '\n';
  if (hearing.pose() && hearing.pose()->state != pose_t::SEARCHING) {
    const pose_t& pose = *hearing.pose();
    page += fmt::format("torso at {:.2f} {:.2f} {:.2f} m", Sane(pose.torso_mm[0]) / 1000,
                        Sane(pose.torso_mm[1]) / 1000, Sane(pose.torso_mm[2]) / 1000);
    if (hearing.body())
      page += fmt::format(", stature {:.0f} mm", Sane(hearing.body()->stature_mm));
    page += '\n';
  }
  const ServiceReport& report = hearing.report();
  if (report.people.size() > 1)
    page += '\n' + TableOf(PersonFields(), PeopleOf(report), Shown::kInWatch);
  if (!report.keypoints.senders.empty())
    page += '\n' + TableOf(KeypointFields(), report.keypoints.senders, Shown::kInWatch);
  if (report.told) page += ConclusionText(report);
  if (report.recording.state == RecordingStatus::State::kRunning) page += RunningText(report);
  if (hearing.HasStatus() && report.told)
    page += '\n' + CamerasText(hearing) + '\n' + SetsText(report);
  return page;
}

/// Overwrites the screen from the top, without flicker.
void Show(const std::string& page) {
  std::string text = "\x1b[H";
  for (const char c : page) text += c == '\n' ? "\x1b[K\n" : std::string(1, c);
  text += "\x1b[J";
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

void TellHearing(const Hearing& hearing, const Silence& silence, std::int64_t now_ns,
                 const std::string& url, bool on_terminal) {
  const bool is_silent = hearing.IsSilent(now_ns);
  if (on_terminal) return Show(is_silent ? silence.Text() + '\n' : Page(hearing, url));
  const std::string line = is_silent ? silence.Text() : Line(hearing);
  std::fputs((line + '\n').c_str(), stdout);
  std::fflush(stdout);
}

struct WatchOptions {
  std::string url = LcmConfig().url;
  std::string prefix;
  std::optional<double> seconds;
};

void Watch(const WatchOptions& options) {
  StopOnSignals();
  MessageSource source(options.url);
  Hearing hearing(source.lcm(), options.prefix);
  const Silence silence(source.lcm(), options.url, options.prefix);
  const bool on_terminal = isatty(STDOUT_FILENO) == 1;
  if (on_terminal) std::fputs("\x1b[2J", stdout);
  const std::int64_t begin_ns = SteadyNs();
  std::int64_t next_ns = begin_ns + kPageNs;
  while (!StopAsked() && source.Handle(kWaitForNews)) {
    const std::int64_t now_ns = SteadyNs();
    if (options.seconds && static_cast<double>(now_ns - begin_ns) > *options.seconds * 1e9) break;
    if (now_ns < next_ns) continue;
    next_ns = now_ns + (on_terminal ? kPageNs : kLineNs);
    hearing.Age(now_ns);
    TellHearing(hearing, silence, now_ns, options.url, on_terminal);
  }
  // Print what the log had since the last line.
  if (source.is_log() && !StopAsked())
    TellHearing(hearing, silence, SteadyNs(), options.url, on_terminal);
}

}  // namespace

void AddWatchCommand(CLI::App& app) {
  auto options = std::make_shared<WatchOptions>();
  CLI::App* command =
      app.add_subcommand("watch", "Show rate, latency, cameras and fit live in the terminal");
  command->add_option("--url", options->url, "LCM URL; file://LOG plays a log")
      ->capture_default_str();
  command->add_option("--prefix", options->prefix, "prefix of the LCM channel names");
  command->add_option("--seconds", options->seconds, "stop after this many seconds")
      ->check(NumberFrom(0.001, 1e8));
  command->callback([options] { Watch(*options); });
}

}  // namespace mocap

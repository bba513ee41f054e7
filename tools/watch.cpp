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
#include <mocap/people_t.hpp>
#include <mocap/pose_t.hpp>
#include <mocap/service_t.hpp>
#include <mocap/status_t.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/config.h"
#include "core/people/people_capture.h"
#include "daemon/base/number_option.h"
#include "daemon/messages/channel_name.h"
#include "daemon/messages/decode_message.h"
#include "daemon/messages/silence.h"
#include "daemon/status/followed_person.h"
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
constexpr const char* kCameraStates[] = {"starting", "streaming", "LOST", "ended"};

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
    lcm.subscribe(prefix + "MOCAP_STATUS", &Hearing::OnStatus, this);
    lcm.subscribe(prefix + kServiceChannel, &Hearing::OnService, this);
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
  const std::optional<people_t>& people() const { return people_; }
  const std::optional<status_t>& status() const { return status_; }
  const std::optional<service_t>& service() const { return service_; }

 private:
  struct Arrival {
    std::int64_t time_ns = 0;
    double latency_ms = 0;
  };

  void OnPose(const lcm::ReceiveBuffer* buffer, const std::string&) {
    std::optional<pose_t> pose = DecodeMessage<pose_t>(BytesOf(*buffer));
    if (!pose) return;
    heard_ns_ = SteadyNs();
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
    Take(DecodeMessage<body_t>(BytesOf(*buffer)), body_);
  }
  void OnPeople(const lcm::ReceiveBuffer* buffer, const std::string&) {
    Take(DecodeMessage<people_t>(BytesOf(*buffer)), people_);
  }
  void OnStatus(const lcm::ReceiveBuffer* buffer, const std::string&) {
    Take(DecodeMessage<status_t>(BytesOf(*buffer)), status_);
  }
  void OnService(const lcm::ReceiveBuffer* buffer, const std::string&) {
    Take(DecodeMessage<service_t>(BytesOf(*buffer)), service_);
  }
  template <typename Message>
  void Take(std::optional<Message> heard, std::optional<Message>& kept) {
    if (!heard) return;
    heard_ns_ = SteadyNs();
    kept = std::move(heard);
  }

  std::int64_t heard_ns_ = SteadyNs();
  std::deque<Arrival> arrivals_;
  std::int64_t missed_ = 0, steps_back_ = 0, poses_ = 0;
  std::optional<pose_t> pose_;
  std::optional<body_t> body_;
  std::optional<people_t> people_;
  std::optional<status_t> status_;
  std::optional<service_t> service_;
};

/// Bounds a number from a message, which anyone may have sent.
double Sane(double value) { return std::isfinite(value) ? std::clamp(value, -1e6, 1e6) : 0; }

/// Makes text from a message printable and bounds its length.
std::string Foreign(const std::string& text) {
  constexpr std::size_t kMostCharacters = 200;
  return Shortened(text, kMostCharacters);
}

std::string StateName(int state) {
  const auto number = static_cast<std::size_t>(state);
  return number < kCaptureStateNames.size() ? std::string(kCaptureStateNames[number]) : "?";
}

/// "person 1 tracking, person 3 (anna) lost".
std::string PeopleText(const people_t& people) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(kMostPeople, people.people.size()); ++i) {
    const person_t& person = people.people[i];
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", LabelOf(person.id, Foreign(person.name)),
                        StateName(person.state));
  }
  return text;
}

/// Appends one line per person.
void AppendPeople(const people_t& people, std::string& page) {
  page += fmt::format("\n{:<24}{:<12}{:>22}{:>9}\n", "person", "state", "torso x y z m", "fit mm");
  for (std::size_t i = 0; i < std::min<std::size_t>(kMostPeople, people.people.size()); ++i) {
    const person_t& person = people.people[i];
    const bool is_tracked = person.state == pose_t::TRACKING;
    page += fmt::format(
        "{:<24}{:<12}{:>22}{:>9}\n",
        std::to_string(person.id) + (person.name.empty() ? "" : "  " + Foreign(person.name)),
        StateName(person.state),
        fmt::format("{:.2f} {:.2f} {:.2f}", Sane(person.torso_mm[0]) / 1000,
                    Sane(person.torso_mm[1]) / 1000, Sane(person.torso_mm[2]) / 1000),
        is_tracked ? fmt::format("{:.0f}", Sane(person.residual_mm)) : "-");
  }
}

std::string PoseLine(const Hearing& hearing) {
  const pose_t& pose = *hearing.pose();
  std::string line = fmt::format("{:<9}  {:5.1f} poses/s  latency {:4.0f} ms",
                                 StateName(pose.state), hearing.Rate(), Sane(hearing.LatencyMs()));
  if (pose.state == pose_t::TRACKING)
    line += fmt::format("  fit {:3.0f} mm", Sane(pose.residual_mm));
  if (hearing.people() && hearing.people()->num_people > 1)
    line += "  " + PeopleText(*hearing.people());
  line += "  " + Counted(pose.voxels, "voxel");
  if (hearing.HearsSeveral())
    return line + "  poses of several daemons are mixed: give each its own lcm.prefix";
  if (hearing.missed() > 0) line += fmt::format("  {} missed here", hearing.missed());
  return line;
}

/// For a daemon that sends no poses: a node, or a studio without frame sets.
std::string StatusLine(const Hearing& hearing) {
  std::string line = "no poses";
  if (hearing.status()) {
    const auto& cameras = hearing.status()->cameras;
    const auto streaming =
        std::ranges::count(cameras, camera_status_t::STREAMING, &camera_status_t::state);
    line += fmt::format("  {} of {} cameras streaming", streaming, cameras.size());
  }
  if (hearing.service() && !hearing.service()->complaint.empty())
    line += "  ! " + Foreign(hearing.service()->complaint.front());
  return line;
}

std::string Line(const Hearing& hearing) {
  return hearing.pose() ? PoseLine(hearing) : StatusLine(hearing);
}

/// Formats a camera's trust, offset and light.
std::string HealthCells(const std::optional<service_t>& service, std::size_t camera) {
  const bool is_told = service && camera < service->camera_trust.size();
  if (!is_told) return fmt::format("{:>8}{:>8}{:>8}", "-", "-", "-");
  const double trust = Sane(service->camera_trust[camera]);
  const std::string light = fmt::format("{:.0f} %", 100 * Sane(service->camera_light[camera]));
  if (trust < 0) return fmt::format("{:>8}{:>8}{:>8}", "-", "-", light);
  return fmt::format("{:>8}{:>8.1f}{:>8}", fmt::format("{:.0f} %", 100 * trust),
                     Sane(service->camera_off_px[camera]), light);
}

void AppendCameras(const Hearing& hearing, std::string& page) {
  const status_t& status = *hearing.status();
  page += fmt::format("\n{:<16}{:<10}{:>9}{:>10}{:>8}{:>8}{:>8}{:>8}{:>8}  {}\n", "camera", "state",
                      "fps", "dropped", "late", "damaged", "trust", "off px", "light",
                      "in the last set");
  for (std::size_t i = 0; i < status.cameras.size(); ++i) {
    const camera_status_t& camera = status.cameras[i];
    const auto state = static_cast<std::size_t>(camera.state);
    const bool is_used =
        hearing.pose() && i < hearing.pose()->camera_used.size() && hearing.pose()->camera_used[i];
    page += fmt::format("{:<16}{:<10}{:>9.1f}{:>10}{:>8}{:>8}{}  {}\n", Foreign(camera.name),
                        state < std::size(kCameraStates) ? kCameraStates[state] : "?",
                        Sane(camera.frames_per_second), camera.dropped, camera.late, camera.torn,
                        HealthCells(hearing.service(), i), is_used ? "yes" : "no");
  }
  page += '\n';
  for (const stage_timing_t& stage : status.stages) {
    page += fmt::format("{:<8} {:6.1f} ms  99 % below {:6.1f}\n", Foreign(stage.name),
                        Sane(stage.p50_ms), Sane(stage.p99_ms));
  }
  page += fmt::format("sets     {} complete, {} incomplete, {} dropped; spread {:.1f} ms\n",
                      status.sets_complete, status.sets_partial, status.sets_dropped,
                      Sane(status.spread_p50_ms));
}

void AppendService(const service_t& service, std::string& page) {
  if (service.complaint.empty()) page += "all is good\n";
  for (const std::string& complaint : service.complaint) page += "! " + Foreign(complaint) + '\n';
  if (service.recording_state != service_t::RUNNING) return;
  page += fmt::format("recording {}, {:.0f} s, {} of all cameras, {} dropped, {:.1f} GB free\n",
                      Foreign(service.recording_folder), Sane(service.recording_seconds),
                      Counted(service.recording_frames, "frame"), service.recording_dropped,
                      static_cast<double>(service.bytes_free) / 1e9);
}

std::string Page(const Hearing& hearing, const std::string& url) {
  std::string page = "mocapd";
  if (hearing.status()) page += ' ' + Foreign(hearing.status()->version);
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
  if (hearing.people() && hearing.people()->num_people > 1) AppendPeople(*hearing.people(), page);
  if (hearing.service()) AppendService(*hearing.service(), page);
  if (hearing.status()) AppendCameras(hearing, page);
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

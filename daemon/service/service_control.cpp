#include "daemon/service/service_control.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <stdexcept>

#include "core/errors.h"
#include "daemon/control/control_socket.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

/// A viewer that keeps watching asks again within this time.
constexpr std::chrono::seconds kLook{10};
/// Usual time limit for a node's answer.
constexpr std::chrono::seconds kPatience{10};
/// The same for beginning a take, and for canceling it where another node has failed.
constexpr std::chrono::seconds kStartPatience{30}, kCancelPatience{20};
// A client that asks still hears which node it is.
static_assert(ServiceControl::kNodePatience < kReplyPatience &&
              kStartPatience + kCancelPatience < kReplyPatience);

std::vector<RecordedPerson> Recorded(const std::vector<FollowedPerson>& people) {
  std::vector<RecordedPerson> recorded;
  for (const FollowedPerson& person : people) {
    recorded.push_back({person.id, person.name, person.sizes});
  }
  return recorded;
}

}  // namespace

ServiceControl::ServiceControl(const ServiceParts& parts, Subjects subjects)
    : parts_(parts),
      subjects_(std::move(subjects)),
      nodes_(parts.config.config().nodes),
      config_(parts.config.config()) {
  if (parts_.pipeline) parts_.pipeline->KnowPeople(subjects_.Known());
}

Pipeline& ServiceControl::Tracking() const {
  if (parts_.pipeline) return *parts_.pipeline;
  throw SetupError("this mocapd is a node and tracks nobody: send this request to the studio");
}

ControlReply ServiceControl::Answer(const ControlRequest& request) {
  return {ControlOutcome::kDone,
          std::visit([this](const auto& of_its_kind) { return Do(of_its_kind); }, request)};
}

void ServiceControl::SetReport(const ServiceReport& report) {
  const std::scoped_lock lock(report_mutex_);
  report_ = report;
  report_ns_ = SteadyNs();
}

std::string ServiceControl::Reload() {
  const std::scoped_lock lock(reload_mutex_);
  const std::string text = ReloadText(parts_.config.Reload());
  {
    const std::scoped_lock config_lock(config_mutex_);
    config_ = parts_.config.config();
  }
  parts_.publisher.SetVoxelsHz(parts_.config.config().lcm.voxels_hz);
  spdlog::info("configuration reloaded: {}", text);
  return text;
}

Config ServiceControl::config() {
  const std::scoped_lock lock(config_mutex_);
  return config_;
}

std::string ServiceControl::Do(const StatusRequest& request) {
  const std::scoped_lock lock(report_mutex_);
  // Includes a recording that has just begun or ended.
  report_.recording = parts_.recorder.Status();
  report_.age_ns = SteadyNs() - report_ns_;
  return request.as_json ? ReportJson(report_) : ReportText(report_);
}

std::string ServiceControl::Do(const ReloadRequest&) {
  return DoEverywhere(nodes_.Ask("reload", kPatience), [this] { return Reload() + '\n'; });
}

std::string ServiceControl::Do(const RecordStartRequest& request) {
  const std::string text = StartRecording(request.name);
  const NodeRequests::Answers answers =
      nodes_.Ask("record start " + request.name, kStartPatience).Wait();
  if (const std::string problem = answers.Problem(); !problem.empty()) {
    // A take that lacks some of its cameras is useless.
    const std::string left =
        CancelTake(nodes_.AskWhoDid(answers, "record cancel " + request.name, kCancelPatience),
                   [&] { parts_.recorder.Cancel(request.name); });
    spdlog::warn("the recording {} was canceled: {}; {}", request.name, problem, left);
    throw std::runtime_error(problem + "; " + left);
  }
  nodes_record_.store(!nodes_.empty());
  return text + answers.Text();
}

std::string ServiceControl::StartRecording(const std::string& name) {
  RequireNotLearning();
  const auto folder = parts_.recorder.Start(name, config().service.recording,
                                            Recorded(Tracked(parts_.view.people())));
  spdlog::info("recording {}", folder.c_str());
  return fmt::format("recording {}\n", folder.string());
}

std::string ServiceControl::Do(const RecordCancelRequest& request) {
  parts_.recorder.Cancel(request.name);
  spdlog::info("the recording {} was canceled by the studio", request.name);
  return "canceled " + request.name + '\n';
}

std::string ServiceControl::Do(const RecordStopRequest&) {
  nodes_record_.store(false);
  return DoEverywhere(nodes_.Ask("record stop", kNodePatience), [this] {
    // A studio that was started anew ends what its nodes still record.
    return nodes_.empty() || parts_.recorder.HasTake() ? StopRecording() : "";
  });
}

std::string ServiceControl::StopRecording() {
  const RecordingStatus status = parts_.recorder.Stop();
  if (status.state != RecordingStatus::State::kComplete) {
    const std::string text = "the recording failed: " + status.problem +
                             "; what was recorded is in " + status.folder.string();
    spdlog::error("{}", text);
    throw std::runtime_error(text);
  }
  const std::string text = CompletedText(status);
  spdlog::info("recorded {}", text);
  return text + '\n';
}

bool ServiceControl::IsRecording() const {
  return nodes_record_.load() || parts_.recorder.Status().state == RecordingStatus::State::kRunning;
}

void ServiceControl::EndRecording() {
  try {
    Do(RecordStopRequest{});
  } catch (const std::exception&) {
    // Each failure is in the log.
  }
}

std::string ServiceControl::Do(const SubjectNewRequest&) {
  const std::vector<FollowedPerson> people = parts_.view.people();
  Tracking().ChangeSubject({});
  const std::string text = people.empty() ? "the next person will be measured"
                                          : Printable(LabelsOf(people)) + " will be measured again";
  spdlog::info("{}", text);
  return text + '\n';
}

std::string ServiceControl::Do(const SubjectSaveRequest& request) {
  const std::vector<FollowedPerson> people = Tracked(parts_.view.people());
  if (people.empty()) throw std::runtime_error("nobody is tracked, so there are no sizes to save");
  const FollowedPerson& person = ChoosePerson(people, request.person);
  subjects_.Save(request.name, person.sizes);
  Tracking().NamePerson(person.id, request.name);
  Tracking().KnowPeople(subjects_.Known());
  spdlog::info("person {} is saved as subject {}", person.id, request.name);
  return fmt::format("person {} is saved as {}: stature {:.0f} mm\n", person.id, request.name,
                     person.sizes.Stature());
}

std::string ServiceControl::Do(const SubjectLoadRequest& request) {
  const BodySizes sizes = subjects_.Load(request.name);
  const std::size_t people = parts_.view.people().size();
  Tracking().ChangeSubject(KnownPerson{request.name, sizes});
  spdlog::info("subject {} is tracked", request.name);
  return fmt::format("{} is tracked from now on: stature {:.0f} mm{}\n", request.name,
                     sizes.Stature(),
                     people > 1 ? "; the first person found is taken for " + request.name : "");
}

std::string ServiceControl::Do(const BackgroundLearnRequest& request) {
  const bool has_cameras = nodes_.empty() || config().source.driver != "none";
  return DoEverywhere(
      nodes_.Ask(request.anyway ? "background learn anyway" : "background learn", kNodePatience),
      [&] { return has_cameras ? LearnBackground(request.anyway) : ""; });
}

void ServiceControl::RequireNoRecording() const {
  if (parts_.recorder.Status().state != RecordingStatus::State::kRunning) return;
  throw std::runtime_error(
      "a take is being recorded, and a take has only one background; stop it first: mocap record "
      "stop");
}

void ServiceControl::RequireNotLearning() const {
  if (!parts_.occupied.IsUnderWay()) return;
  throw std::runtime_error(
      "the background is being learned while people move about; mocap background status says when "
      "it is done");
}

std::string ServiceControl::LearnBackground(bool anyway) {
  RequireNoRecording();
  RequireNotLearning();
  const std::string text = parts_.background.Learn(anyway);
  spdlog::info("the background was learned again");
  return text;
}

std::string ServiceControl::Do(const BackgroundOccupiedRequest& request) {
  if (!nodes_.empty() && config().source.driver == "none")
    throw SetupError(
        "this studio has no cameras of its own: run mocap background learn --occupied on each of "
        "its nodes");
  RequireNoRecording();
  parts_.occupied.Begin({request.seconds, request.accepted});
  spdlog::info("learning the background while people move about");
  return parts_.occupied.Progress();
}

std::string ServiceControl::Do(const BackgroundResultRequest&) {
  return parts_.occupied.Progress();
}

std::string ServiceControl::Do(const BackgroundStatusRequest&) {
  const std::string learning = parts_.occupied.Present();
  const std::scoped_lock lock(report_mutex_);
  return BackgroundText(report_) + learning;
}

std::string ServiceControl::Do(const LookRequest&) {
  parts_.preview.Look(kLook);
  nodes_.Look();
  return fmt::format("pictures and voxels are published for {} s\n", kLook.count());
}

std::string ServiceControl::Do(const SubjectListRequest&) {
  std::string text;
  for (const std::string& name : subjects_.Names()) {
    try {
      text +=
          fmt::format("{:<24}stature {:.0f} mm\n", Printable(name), subjects_.Load(name).Stature());
    } catch (const SetupError& error) {
      text += fmt::format("{:<24}{}\n", Printable(name), Printable(error.what()));
    }
  }
  return text.empty() ? "no subject is saved yet\n" : text;
}

}  // namespace mocap

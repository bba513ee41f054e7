#include "daemon/status/service_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "daemon/base/json_object.h"
#include "daemon/recording/recorder.h"
#include "daemon/status/diagnostics.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

constexpr std::array<std::string_view, 4> kCameraStateNames = {"starting", "streaming", "lost",
                                                               "ended"};
constexpr std::array kTold = {Stage::kSegment, Stage::kCarve,   Stage::kLabel,
                              Stage::kFilter,  Stage::kPublish, Stage::kTotal};

std::string_view NameOf(CaptureState state) {
  return kCaptureStateNames[static_cast<std::size_t>(state)];
}
std::string_view NameOf(CameraState state) {
  return kCameraStateNames[static_cast<std::size_t>(state)];
}
std::string_view NameOf(Stage stage) { return kStageNames[static_cast<std::size_t>(stage)]; }

int Streaming(const PipelineStatus& status) {
  return static_cast<int>(std::ranges::count(status.cameras, CameraState::kStreaming,
                                             [](const CameraStatus& c) { return c.state; }));
}

std::string StateText(const ServiceReport& report) {
  const CaptureState state = report.now.status.state;
  std::string text(NameOf(state));
  if (state == CaptureState::kTracking) {
    text += fmt::format(", fit {:.0f} mm", report.fit.residual_mm);
  }
  if (report.people.size() > 1) text += fmt::format(", {} people", report.people.size());
  return text + ", " + Counted(report.fit.voxels, "voxel");
}

std::string Percentiles(const LatencyHistogram& histogram) {
  return fmt::format("{:.1f} ms (99 % below {:.1f})", histogram.PercentileMs(0.5),
                     histogram.PercentileMs(0.99));
}

using Recorded = RecordingStatus::State;
constexpr std::array<std::string_view, 4> kRecordedNames = {"none", "running", "complete",
                                                            "failed"};

/// "walk, 12 s, 360 frame sets of 6 cameras, 0 frames dropped".
std::string RecordingText(const RecordingStatus& recording) {
  if (recording.state == Recorded::kNone) return "none since mocapd started";
  std::string text = fmt::format("{}, {}, {}", recording.folder.string(),
                                 Duration(recording.duration_ns), ContentText(recording));
  if (recording.waiting > 0) text += ", " + Counted(recording.waiting, "frame") + " in memory";
  if (recording.state == Recorded::kComplete) text = "complete: " + text;
  if (recording.state == Recorded::kFailed) text = "FAILED: " + text;
  if (!recording.problem.empty()) text += "; " + recording.problem;
  return text;
}

JsonObject RecordingJson(const RecordingStatus& recording) {
  JsonObject json;
  json.Add("state", kRecordedNames[static_cast<std::size_t>(recording.state)]);
  json.Add("folder", recording.folder.string());
  json.Add("seconds", static_cast<double>(recording.duration_ns) / 1e9, 1);
  json.Add("frames", recording.frames);
  json.Add("waiting", recording.waiting);
  json.Add("dropped", recording.dropped);
  json.Add("problem", recording.problem);
  return json;
}

JsonObject TimingJson(const LatencyHistogram& histogram) {
  JsonObject json;
  json.Add("p50_ms", histogram.PercentileMs(0.5), 3);
  json.Add("p99_ms", histogram.PercentileMs(0.99), 3);
  json.Add("max_ms", histogram.MaxMs(), 3);
  return json;
}

std::string Line(const std::string& label, const std::string& text) {
  return fmt::format("{:<12} {}\n", label, Printable(text));
}

/// "9 days old, /etc/mocapd/calibration.toml".
std::string MadeText(const Made& made, std::int64_t epoch_s) {
  if (made.made_s == 0) return made.where;
  return Duration((epoch_s - made.made_s) * 1'000'000'000) + " old, " + made.where;
}

bool IsCompared(const CameraStatus& camera) {
  return camera.health.moments >= HealthWatch::kFewestMoments;
}

/// How well the cameras' silhouettes agree with each other.
std::string AgreementText(const PipelineStatus& status) {
  double worst_px = 0;
  for (const CameraStatus& camera : status.cameras) {
    if (IsCompared(camera)) worst_px = std::max(worst_px, camera.health.shift_px.norm());
  }
  if (std::ranges::none_of(status.cameras, IsCompared)) {
    return "not compared yet: that needs a person who walks about";
  }
  return fmt::format("cameras agree within {:.1f} px", worst_px);
}

std::string CameraTable(const ServiceReport& report) {
  const auto percent = [](std::optional<double> share) {
    return share ? fmt::format("{:.0f} %", 100 * *share) : "-";
  };
  std::string text = fmt::format(
      "{:<16}{:<10}{:>9}{:>12}{:>9}{:>9}{:>9}{:>8}{:>8}{:>8}{:>9}{:>9}\n", "camera", "state", "fps",
      "frames", "dropped", "late", "damaged", "trust", "off px", "light", "unknown", "missed");
  for (std::size_t i = 0; i < report.now.status.cameras.size(); ++i) {
    const CameraStatus& camera = report.now.status.cameras[i];
    const bool known = IsCompared(camera);
    text += fmt::format(
        "{:<16}{:<10}{:>9.1f}{:>12}{:>9}{:>9}{:>9}{:>8}{:>8}{:>8}{:>9}{:>9}\n", camera.name,
        NameOf(camera.state), report.now.frames_per_second[i], camera.frames, camera.dropped,
        camera.late, camera.torn, known ? percent(camera.health.overlap) : "-",
        known ? fmt::format("{:.1f}", camera.health.shift_px.norm()) : "-", percent(camera.light),
        percent(camera.health.unknown_share), percent(camera.health.miss_rate));
  }
  return text;
}

// Adds the certainty if the name was recognized by the sizes.
std::string NameText(const FollowedPerson& person) {
  if (person.name.empty()) return {};
  const std::string text = "  " + Printable(person.name);
  return person.certainty < 1 ? text + fmt::format(" ({:.0f} %)", 100 * person.certainty) : text;
}

double SecondsOf(const FollowedPerson& person, const ServiceReport& report) {
  return static_cast<double>(report.people_ns - person.since_ns) / 1e9;
}

std::string PeopleTable(const ServiceReport& report) {
  if (report.people.empty()) return {};
  std::string text = fmt::format("{:<24}{:<12}{:>16}{:>9}{:>12}  {}\n", "person", "state", "x y m",
                                 "fit mm", "stature mm", "tracked for");
  for (const FollowedPerson& person : report.people) {
    const bool is_tracked = person.state == CaptureState::kTracking;
    text += fmt::format(
        "{:<24}{:<12}{:>16}{:>9}{:>12.0f}  {}\n", std::to_string(person.id) + NameText(person),
        NameOf(person.state),
        fmt::format("{:.2f} {:.2f}", person.torso_W.x() / 1000, person.torso_W.y() / 1000),
        is_tracked ? fmt::format("{:.0f}", person.residual_mm) : "-", person.sizes.Stature(),
        Duration(report.people_ns - person.since_ns));
  }
  return text + '\n';
}

JsonObject PersonJson(const FollowedPerson& person, const ServiceReport& report) {
  JsonObject json;
  json.Add("id", person.id);
  json.Add("name", person.name);
  json.Add("name_certainty", person.certainty, 3);
  json.Add("state", NameOf(person.state));
  json.Add("x_mm", person.torso_W.x(), 1);
  json.Add("y_mm", person.torso_W.y(), 1);
  json.Add("z_mm", person.torso_W.z(), 1);
  json.Add("residual_mm", person.residual_mm, 2);
  json.Add("stature_mm", person.sizes.Stature(), 1);
  json.Add("seconds", SecondsOf(person, report), 1);
  return json;
}

JsonObject MovedJson(const MovedFurniture& thing) {
  JsonObject json;
  json.Add("camera", thing.camera);
  json.Add("place", thing.place);
  json.Add("share", thing.share, 4);
  json.Add("seconds", thing.age_ns / 1'000'000'000);
  return json;
}

JsonObject MadeJson(const Made& made) {
  JsonObject json;
  json.Add("where", made.where);
  json.Add("made_s", made.made_s);
  return json;
}

JsonObject CameraJson(const CameraStatus& camera, double frames_per_second) {
  JsonObject json;
  json.Add("name", camera.name);
  json.Add("node", camera.node);
  json.Add("state", NameOf(camera.state));
  json.Add("frames_per_second", frames_per_second, 2);
  json.Add("frames", camera.frames);
  json.Add("dropped", camera.dropped);
  json.Add("late", camera.late);
  json.Add("torn", camera.torn);
  json.Add("compared_moments", camera.health.moments);
  json.Add("trust", camera.health.overlap, 3);
  json.Add("right_px", camera.health.shift_px.x(), 2);
  json.Add("down_px", camera.health.shift_px.y(), 2);
  json.Add("light", camera.light, 3);
  json.Add("nudged_px", camera.nudged_px, 2);
  json.Add("unknown_share", camera.health.unknown_share.value_or(-1), 3);
  json.Add("miss_rate", camera.health.miss_rate.value_or(-1), 3);
  return json;
}

std::string TrackingText(const ServiceReport& report) {
  const PipelineStatus& status = report.now.status;
  const StageHistograms& recent = report.now.recent;
  std::string text = Line("poses", "on " + report.lcm_url);
  text += Line("state", StateText(report));
  text += Line("sets", fmt::format("{:.1f} a second; {} complete, {} incomplete, {} dropped",
                                   report.now.sets_per_second, status.sets_complete,
                                   status.sets_partial, status.sets_dropped));
  text += Line("spread", Percentiles(recent[Stage::kSpread]));
  text += Line("latency", Percentiles(recent[Stage::kLatency]));
  for (const Stage stage : kTold) {
    text += Line("  " + std::string(NameOf(stage)), Percentiles(recent[stage]));
  }
  return text;
}

/// For a node, which does not track.
std::string SendingText(const ServiceReport& report) {
  return Line("node", report.node) +
         Line("silhouettes",
              fmt::format("{:.1f} a second, on {}", report.now.sets_per_second, report.lcm_url)) +
         Line("  segment", Percentiles(report.now.recent[Stage::kSegment]));
}

}  // namespace

std::string ReportLine(const ServiceReport& report) {
  const PipelineStatus& status = report.now.status;
  std::string line =
      report.node.empty()
          ? fmt::format("{}; {:.1f} sets/s, latency {:.0f} ms", StateText(report),
                        report.now.sets_per_second,
                        report.now.recent[Stage::kLatency].PercentileMs(0.5))
          : fmt::format("node {}; {:.1f} silhouettes/s", report.node, report.now.sets_per_second);
  line += fmt::format(", {} of {} cameras", Streaming(status), status.cameras.size());
  if (report.recording.state == Recorded::kRunning) {
    line += fmt::format("; recording {}, {}", report.recording.folder.stem().c_str(),
                        Duration(report.recording.duration_ns));
  }
  const std::vector<std::string> complaints = Diagnostics(report);
  if (!complaints.empty()) line += "; " + complaints.front();
  return line;
}

std::string ReportText(const ServiceReport& report) {
  const PipelineStatus& status = report.now.status;
  const std::vector<std::string> complaints = Diagnostics(report);
  std::string text = complaints.empty() ? "all is good\n" : "";
  for (const std::string& complaint : complaints) text += "! " + Printable(complaint) + '\n';
  text += '\n' + Line("mocapd", fmt::format("{}, up {}; {}", MOCAP_VERSION, Duration(report.up_ns),
                                            report.studio));
  text += report.node.empty() ? TrackingText(report) : SendingText(report);
  text += Line("recording", RecordingText(report.recording));
  text += Line("disk",
               fmt::format("{:.1f} GB free for takes in {}",
                           static_cast<double>(report.bytes_free) / 1e9, report.takes.string()));
  text += Line("calibration",
               MadeText(report.calibration, report.epoch_s) + "; " + AgreementText(status));
  text += Line("background", MadeText(report.background, report.epoch_s)) + '\n';
  return text + PeopleTable(report) + NodeTable(report.nodes) + CameraTable(report);
}

std::string BackgroundText(const ServiceReport& report) {
  std::string text = Printable(MadeText(report.background, report.epoch_s)) + '\n';
  for (const CameraStatus& camera : report.now.status.cameras) {
    text +=
        fmt::format("{}: {:.0f} % of the light that was learned", camera.name, 100 * camera.light);
    if (camera.nudged_px > 0) text += fmt::format(", moved by {:.1f} px", camera.nudged_px);
    text += '\n';
  }
  return text;
}

std::string ReportJson(const ServiceReport& report) {
  const PipelineStatus& status = report.now.status;
  JsonObject json;
  const std::vector<std::string> complaints = Diagnostics(report);
  json.Add("version", MOCAP_VERSION);
  json.Add("good", complaints.empty());
  json.Add("complaints", complaints);
  json.Add("studio", report.studio);
  json.Add("up_seconds", report.up_ns / 1'000'000'000);
  json.Add("lcm_url", report.lcm_url);
  json.Add("state", NameOf(status.state));
  json.Add("residual_mm", report.fit.residual_mm, 2);
  json.Add("voxels", report.fit.voxels);
  std::vector<JsonObject> people;
  for (const FollowedPerson& person : report.people) people.push_back(PersonJson(person, report));
  json.Add("people", people);
  json.Add("sets_per_second", report.now.sets_per_second, 2);
  json.Add("sets_complete", status.sets_complete);
  json.Add("sets_partial", status.sets_partial);
  json.Add("sets_dropped", status.sets_dropped);
  json.Add("spread", TimingJson(report.now.recent[Stage::kSpread]));
  json.Add("latency", TimingJson(report.now.recent[Stage::kLatency]));
  for (const Stage stage : kTold) json.Add(NameOf(stage), TimingJson(report.now.recent[stage]));
  std::vector<JsonObject> cameras;
  for (std::size_t i = 0; i < status.cameras.size(); ++i) {
    cameras.push_back(CameraJson(status.cameras[i], report.now.frames_per_second[i]));
  }
  json.Add("cameras", cameras);
  json.Add("node", report.node);
  std::vector<JsonObject> nodes;
  for (const NodeReport& node : report.nodes.nodes) nodes.push_back(NodeJson(node));
  json.Add("nodes", nodes);
  json.Add("calibration", MadeJson(report.calibration));
  json.Add("background", MadeJson(report.background));
  std::vector<JsonObject> moved;
  for (const MovedFurniture& thing : report.moved) moved.push_back(MovedJson(thing));
  json.Add("moved", moved);
  json.Add("takes", report.takes.string());
  json.Add("bytes_free", report.bytes_free);
  json.Add("recording", RecordingJson(report.recording));
  return json.Text() + '\n';
}

}  // namespace mocap

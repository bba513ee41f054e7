#include "daemon/status/service_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "daemon/recording/recorder.h"
#include "daemon/status/diagnostics.h"
#include "daemon/status/status_fields.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

constexpr std::array kTold = {Stage::kSegment, Stage::kCarve,   Stage::kLabel,
                              Stage::kFilter,  Stage::kPublish, Stage::kTotal};

std::string StateText(const ServiceReport& report) {
  const CaptureState state = report.now.status.state;
  std::string text(NameOf(state));
  if (state == CaptureState::kTracking) {
    text += fmt::format(", fit {:.0f} mm", report.fit.residual_mm);
  }
  if (report.people.size() > 1) text += fmt::format(", {} people", report.people.size());
  return text + ", " + Counted(report.fit.voxels, "voxel");
}

std::string Percentiles(const StageTiming& timing) {
  return fmt::format("{:.1f} ms (99 % below {:.1f})", timing.p50_ms, timing.p99_ms);
}

using Recorded = RecordingStatus::State;

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

std::string Line(const std::string& label, const std::string& text) {
  return fmt::format("{:<12} {}\n", label, Printable(text));
}

/// "9 days old, /etc/mocapd/calibration.toml".
std::string MadeText(const Made& made, std::int64_t epoch_s) {
  if (made.made_s == 0) return made.where;
  return Duration((epoch_s - made.made_s) * 1'000'000'000) + " old, " + made.where;
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

/// A table and an empty line; nothing if there is nothing to list.
template <typename Of>
std::string Paragraph(std::span<const StatusField<Of>> fields, const std::vector<Of>& list) {
  return list.empty() ? "" : TableOf(fields, list, Shown::kInStatus) + '\n';
}

std::string TrackingText(const ServiceReport& report) {
  return Line("poses", "on " + report.lcm_url) + Line("state", StateText(report)) +
         SetsText(report);
}

/// For a node, which does not track.
std::string SendingText(const ServiceReport& report) {
  return Line("node", report.node) +
         Line("silhouettes",
              fmt::format("{:.1f} a second, on {}", report.now.sets_per_second, report.lcm_url)) +
         Line("  segment", Percentiles(report.now.recent[Stage::kSegment]));
}

}  // namespace

int Streaming(const PipelineStatus& status) {
  return static_cast<int>(std::ranges::count(status.cameras, CameraState::kStreaming,
                                             [](const CameraStatus& c) { return c.state; }));
}

std::string ReportLine(const ServiceReport& report) {
  const PipelineStatus& status = report.now.status;
  std::string line =
      report.node.empty()
          ? fmt::format("{}; {:.1f} sets/s, latency {:.0f} ms", StateText(report),
                        report.now.sets_per_second, report.now.recent[Stage::kLatency].p50_ms)
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

std::string ConclusionText(const ServiceReport& report) {
  std::string text;
  for (const std::string& complaint : Diagnostics(report))
    text += "! " + Printable(complaint) + '\n';
  return text.empty() ? "all is good\n" : text;
}

std::string SetsText(const ServiceReport& report) {
  const PipelineStatus& status = report.now.status;
  const StageTimings& recent = report.now.recent;
  std::string text =
      Line("sets", fmt::format("{:.1f} a second; {} complete, {} incomplete, {} dropped",
                               report.now.sets_per_second, status.sets_complete,
                               status.sets_partial, status.sets_dropped));
  text += Line("spread", Percentiles(recent[Stage::kSpread]));
  text += Line("latency", Percentiles(recent[Stage::kLatency]));
  for (const Stage stage : kTold)
    text += Line("  " + std::string(NameOf(stage)), Percentiles(recent[stage]));
  return text;
}

std::string ReportText(const ServiceReport& report) {
  std::string text = ConclusionText(report) + '\n';
  text += Line("mocapd",
               fmt::format("{}, up {}; {}", report.version, Duration(report.up_ns), report.studio));
  text += report.node.empty() ? TrackingText(report) : SendingText(report);
  text += Line("recording", RecordingText(report.recording));
  text += Line("disk",
               fmt::format("{:.1f} GB free for takes in {}",
                           static_cast<double>(report.bytes_free) / 1e9, report.takes.string()));
  text += Line("calibration", MadeText(report.calibration, report.epoch_s) + "; " +
                                  AgreementText(report.now.status));
  text += Line("background", MadeText(report.background, report.epoch_s)) + '\n';
  return text + Paragraph(PersonFields(), PeopleOf(report)) +
         Paragraph(NodeFields(), report.nodes.nodes) +
         Paragraph(KeypointFields(), report.keypoints.senders) +
         TableOf(CameraFields(), CamerasOf(report), Shown::kInStatus);
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
  return JsonText(ObjectOf(ServiceFields(), report)) + '\n';
}

}  // namespace mocap

#include "daemon/service_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "daemon/json_object.h"

namespace mocap {
namespace {

constexpr std::array<std::string_view, 4> kCameraStateNames = {"starting", "streaming", "lost",
                                                               "ended"};
/// A camera that gives less than this share of its frames is named.
constexpr double kGoodRate = 0.9;
/// Cameras further apart than this share of a period blur whoever moves.
constexpr double kWideSpread = 0.25;
constexpr std::array kTold = {Stage::kSegment, Stage::kCarve, Stage::kLabel, Stage::kFilter,
                              Stage::kTotal};

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

std::string Duration(std::int64_t ns) {
  const std::int64_t seconds = ns / 1'000'000'000;
  if (seconds < 120) return fmt::format("{} s", seconds);
  if (seconds < 7200) return fmt::format("{} min", seconds / 60);
  return fmt::format("{} h {} min", seconds / 3600, seconds / 60 % 60);
}

std::string StateText(const ServiceReport& report) {
  const CaptureState state = report.now.status.state;
  std::string text(NameOf(state));
  if (state == CaptureState::kTracking) {
    text += fmt::format(", fit {:.0f} mm", report.fit.residual_mm);
  }
  return text + fmt::format(", {} voxels", report.fit.voxels);
}

std::string Percentiles(const LatencyHistogram& histogram) {
  return fmt::format("{:.1f} ms (99 % below {:.1f})", histogram.PercentileMs(0.5),
                     histogram.PercentileMs(0.99));
}

void ComplainOfCameras(const ServiceReport& report, std::vector<std::string>& complaints) {
  for (std::size_t i = 0; i < report.now.status.cameras.size(); ++i) {
    const CameraStatus& camera = report.now.status.cameras[i];
    if (camera.state == CameraState::kLost) {
      complaints.push_back(camera.name + " is lost: look at its cable and power");
    } else if (camera.state == CameraState::kStarting) {
      complaints.push_back(camera.name + " has not delivered a frame yet");
    }
    const double rate = report.now.frames_per_second[i];
    const bool is_slow = report.now.sets_per_second > 0 && rate < kGoodRate * report.fps_nominal;
    if (camera.state == CameraState::kStreaming && is_slow) {
      complaints.push_back(
          fmt::format("{} gives {:.1f} of {:.1f} frames a second: look at its exposure time, its "
                      "bus or network, and the processor's load",
                      camera.name, rate, report.fps_nominal));
    }
  }
}

using Recorded = RecordingStatus::State;
constexpr std::array<std::string_view, 4> kRecordedNames = {"none", "running", "complete",
                                                            "failed"};

/// "walk, 12 s, 2160 frames, 0 dropped".
std::string RecordingText(const RecordingStatus& recording) {
  if (recording.state == Recorded::kNone) return "none since the start";
  std::string text =
      fmt::format("{}, {}, {} frames, {} dropped", recording.folder.string(),
                  Duration(recording.duration_ns), recording.frames, recording.dropped);
  if (recording.state == Recorded::kComplete) text = "complete: " + text;
  if (recording.state == Recorded::kFailed) text = "FAILED: " + text;
  if (!recording.problem.empty()) text += "; " + recording.problem;
  if (recording.state == Recorded::kRunning) {
    text += fmt::format("; {:.1f} GB free", static_cast<double>(recording.bytes_free) / 1e9);
  }
  return text;
}

JsonObject RecordingJson(const RecordingStatus& recording) {
  JsonObject json;
  json.Add("state", kRecordedNames[static_cast<std::size_t>(recording.state)]);
  json.Add("folder", recording.folder.string());
  json.Add("seconds", static_cast<double>(recording.duration_ns) / 1e9, 1);
  json.Add("frames", recording.frames);
  json.Add("dropped", recording.dropped);
  json.Add("bytes_free", recording.bytes_free);
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

JsonObject CameraJson(const CameraStatus& camera, double frames_per_second) {
  JsonObject json;
  json.Add("name", camera.name);
  json.Add("state", NameOf(camera.state));
  json.Add("frames_per_second", frames_per_second, 2);
  json.Add("frames", camera.frames);
  json.Add("dropped", camera.dropped);
  json.Add("late", camera.late);
  json.Add("torn", camera.torn);
  return json;
}

}  // namespace

std::vector<std::string> Complaints(const ServiceReport& report) {
  std::vector<std::string> complaints;
  if (report.recording.state == Recorded::kFailed) {
    complaints.push_back("the recording failed: " + report.recording.problem);
  }
  if (report.recording.state == Recorded::kRunning && report.recording.dropped > 0) {
    complaints.push_back(fmt::format(
        "{} frames had no room in the recording: a faster disk or another codec is wanted",
        report.recording.dropped));
  }
  ComplainOfCameras(report, complaints);
  if (report.now.sets_dropped_lately > 0) {
    complaints.push_back(
        fmt::format("{} frame sets were left out lately: the processor is too slow for this rate "
                    "and voxel size, or has other work",
                    report.now.sets_dropped_lately));
  }
  const double spread_ms = report.now.recent[Stage::kSpread].PercentileMs(0.99);
  if (report.fps_nominal > 0 && spread_ms > kWideSpread * 1000 / report.fps_nominal) {
    complaints.push_back(
        fmt::format("the cameras' exposures are {:.1f} ms apart: look at the trigger or the clocks",
                    spread_ms));
  }
  return complaints;
}

std::string ReportLine(const ServiceReport& report) {
  const PipelineStatus& status = report.now.status;
  std::string line =
      fmt::format("{}; {:.1f} sets/s, latency {:.0f} ms, {} of {} cameras", StateText(report),
                  report.now.sets_per_second, report.now.recent[Stage::kLatency].PercentileMs(0.5),
                  Streaming(status), status.cameras.size());
  if (report.recording.state == Recorded::kRunning) {
    line += fmt::format("; recording {}, {}", report.recording.folder.stem().c_str(),
                        Duration(report.recording.duration_ns));
  }
  const std::vector<std::string> complaints = Complaints(report);
  if (!complaints.empty()) line += "; " + complaints.front();
  return line;
}

std::string ReportText(const ServiceReport& report) {
  const PipelineStatus& status = report.now.status;
  const StageHistograms& recent = report.now.recent;
  const std::vector<std::string> complaints = Complaints(report);
  std::string text = complaints.empty() ? "all is good\n" : "";
  for (const std::string& complaint : complaints) text += "! " + complaint + '\n';
  text +=
      fmt::format("\nmocapd {}, up {}; {}\n", MOCAP_VERSION, Duration(report.up_ns), report.studio);
  text += fmt::format("poses     on {}\n", report.lcm_url);
  text += fmt::format("state     {}\n", StateText(report));
  text += fmt::format(
      "sets      {:.1f} a second; {} complete, {} without some camera, {} left out\n",
      report.now.sets_per_second, status.sets_complete, status.sets_partial, status.sets_dropped);
  text += fmt::format("spread    {}\n", Percentiles(recent[Stage::kSpread]));
  text += fmt::format("latency   {}\n", Percentiles(recent[Stage::kLatency]));
  for (const Stage stage : kTold) {
    text += fmt::format("  {:<8}{}\n", NameOf(stage), Percentiles(recent[stage]));
  }
  text += fmt::format("recording {}\n", RecordingText(report.recording));
  text += fmt::format("\n{:<16}{:<10}{:>9}{:>12}{:>9}{:>9}{:>9}\n", "camera", "state", "a second",
                      "frames", "dropped", "late", "torn");
  for (std::size_t i = 0; i < status.cameras.size(); ++i) {
    const CameraStatus& camera = status.cameras[i];
    text += fmt::format("{:<16}{:<10}{:>9.1f}{:>12}{:>9}{:>9}{:>9}\n", camera.name,
                        NameOf(camera.state), report.now.frames_per_second[i], camera.frames,
                        camera.dropped, camera.late, camera.torn);
  }
  return text;
}

std::string ReportJson(const ServiceReport& report) {
  const PipelineStatus& status = report.now.status;
  JsonObject json;
  const std::vector<std::string> complaints = Complaints(report);
  json.Add("version", MOCAP_VERSION);
  json.Add("good", complaints.empty());
  json.Add("complaints", complaints);
  json.Add("studio", report.studio);
  json.Add("up_seconds", report.up_ns / 1'000'000'000);
  json.Add("lcm_url", report.lcm_url);
  json.Add("state", NameOf(status.state));
  json.Add("residual_mm", report.fit.residual_mm, 2);
  json.Add("voxels", report.fit.voxels);
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
  json.Add("recording", RecordingJson(report.recording));
  return json.Text() + '\n';
}

}  // namespace mocap

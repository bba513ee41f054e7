#include "daemon/service/metrics_file.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string_view>

#include "daemon/status/diagnostics.h"

namespace mocap {
namespace {

/// Writes metrics in order. A family's header precedes its first sample.
class MetricsWriter {
 public:
  void Family(std::string_view name, std::string_view type, std::string_view help) {
    name_ = name;
    fmt::format_to(std::back_inserter(text_), "# HELP mocapd_{0} {2}\n# TYPE mocapd_{0} {1}\n",
                   name, type, help);
  }
  void Sample(const std::string& labels, double value) {
    fmt::format_to(std::back_inserter(text_), "mocapd_{}{} {}\n", name_,
                   labels.empty() ? "" : '{' + labels + '}', value);
  }
  void Single(std::string_view name, std::string_view type, std::string_view help, double value) {
    Family(name, type, help);
    Sample("", value);
  }
  std::string Take() { return std::move(text_); }

 private:
  std::string name_;
  std::string text_;
};

void WriteCameras(const ServiceReport& report, MetricsWriter& writer) {
  const auto& cameras = report.now.status.cameras;
  const auto family = [&](std::string_view name, std::string_view help,
                          std::int64_t CameraStatus::*counter) {
    writer.Family(name, "counter", help);
    for (const CameraStatus& camera : cameras) {
      writer.Sample(fmt::format("camera=\"{}\"", camera.name),
                    static_cast<double>(camera.*counter));
    }
  };
  family("camera_frames_total", "Frames delivered.", &CameraStatus::frames);
  family("camera_dropped_frames_total", "Frames lost on the way or dropped.",
         &CameraStatus::dropped);
  family("camera_late_frames_total", "Frames that arrived after their set was processed.",
         &CameraStatus::late);
  family("camera_torn_frames_total", "Damaged frames.", &CameraStatus::torn);
  writer.Family("camera_up", "gauge", "1 while the camera streams.");
  for (const CameraStatus& camera : cameras) {
    writer.Sample(fmt::format("camera=\"{}\"", camera.name),
                  camera.state == CameraState::kStreaming ? 1 : 0);
  }
}

void WriteHealth(const ServiceReport& report, MetricsWriter& writer) {
  const auto& cameras = report.now.status.cameras;
  writer.Family("camera_light_ratio", "gauge", "Brightness relative to the learned background.");
  for (const CameraStatus& camera : cameras) {
    writer.Sample(fmt::format("camera=\"{}\"", camera.name), camera.light);
  }
  writer.Family("camera_trust_ratio", "gauge", "Overlap with the hull of the other cameras.");
  for (const CameraStatus& camera : cameras) {
    if (camera.health.moments < HealthWatch::kFewestMoments) continue;
    writer.Sample(fmt::format("camera=\"{}\"", camera.name), camera.health.overlap);
  }
  writer.Family("camera_unknown_ratio", "gauge", "Share of unknown pixels where people are shown.");
  for (const CameraStatus& camera : cameras) {
    if (!camera.health.unknown_share) continue;
    writer.Sample(fmt::format("camera=\"{}\"", camera.name), *camera.health.unknown_share);
  }
  writer.Family("camera_miss_ratio", "gauge", "Share of people called empty that others show.");
  for (const CameraStatus& camera : cameras) {
    if (!camera.health.miss_rate) continue;
    writer.Sample(fmt::format("camera=\"{}\"", camera.name), *camera.health.miss_rate);
  }
}

void WriteStages(const ServiceReport& report, MetricsWriter& writer) {
  writer.Family("stage_seconds", "gauge", "Recent duration of a stage; latency from capture.");
  for (int i = 0; i < kStageCount; ++i) {
    const LatencyHistogram& recent = report.now.recent[static_cast<Stage>(i)];
    for (const double share : {0.5, 0.99}) {
      writer.Sample(fmt::format("stage=\"{}\",quantile=\"{}\"", kStageNames[i], share),
                    recent.PercentileMs(share) / 1000);
    }
  }
}

}  // namespace

std::string MetricsText(const ServiceReport& report) {
  const PipelineStatus& status = report.now.status;
  MetricsWriter writer;
  writer.Family("build_info", "gauge", "Version of the daemon.");
  writer.Sample(fmt::format("version=\"{}\"", MOCAP_VERSION), 1);
  writer.Single("up_seconds", "gauge", "Time since the start.",
                static_cast<double>(report.up_ns) / 1e9);
  writer.Family("state", "gauge", "1 for the current state.");
  for (std::size_t i = 0; i < kCaptureStateNames.size(); ++i) {
    writer.Sample(fmt::format("state=\"{}\"", kCaptureStateNames[i]),
                  i == static_cast<std::size_t>(status.state) ? 1 : 0);
  }
  writer.Single("people", "gauge", "Number of people tracked.",
                static_cast<double>(report.people.size()));
  writer.Single("residual_meters", "gauge", "Mean distance of the fit.",
                report.fit.residual_mm / 1000);
  writer.Family("sets_total", "counter", "Frame sets by outcome.");
  writer.Sample("outcome=\"complete\"", static_cast<double>(status.sets_complete));
  writer.Sample("outcome=\"partial\"", static_cast<double>(status.sets_partial));
  writer.Sample("outcome=\"dropped\"", static_cast<double>(status.sets_dropped));
  writer.Single("complaints", "gauge", "Number of current diagnostics.",
                static_cast<double>(Diagnostics(report).size()));
  WriteStages(report, writer);
  WriteCameras(report, writer);
  WriteHealth(report, writer);
  writer.Single("free_bytes", "gauge", "Free space on the disk for takes.",
                static_cast<double>(report.bytes_free));
  return writer.Take();
}

bool WriteMetrics(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path unfinished = file.string() + ".part";
  std::ofstream out(unfinished, std::ios::binary);
  out << text;
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(unfinished, file, error);
  if (out && !error) return true;
  std::filesystem::remove(unfinished, error);
  return false;
}

}  // namespace mocap

#include "daemon/service/metrics_file.h"

#include <fmt/format.h>

#include <fstream>
#include <span>
#include <string_view>

#include "daemon/status/status_fields.h"

namespace mocap {
namespace {

std::string Braced(const std::string& label, std::string_view more) {
  const std::string both = label + (label.empty() || more.empty() ? "" : ",") + std::string(more);
  return both.empty() ? both : '{' + both + '}';
}

double NumberOf(const Json& value) {
  return value.is_boolean() ? static_cast<double>(value.get<bool>()) : value.get<double>();
}

/// Appends a sample of each field for each of a list. A family's header precedes its first sample.
/// @param label_of  tells it apart from the others.
template <typename Of>
void AddMetrics(std::span<const StatusField<Of>> fields, const auto& list,
                std::string (*label_of)(const Of&), std::string& text) {
  std::string_view family;
  for (const StatusField<Of>& field : fields) {
    const Metric& metric = field.metric;
    if (metric.name.empty()) continue;
    if (metric.name != family) {
      const char* type = metric.name.ends_with("_total") ? "counter" : "gauge";
      text += fmt::format("# HELP mocapd_{0} {2}\n# TYPE mocapd_{0} {1}\n", metric.name, type,
                          metric.help);
    }
    family = metric.name;
    for (const Of& of : list) {
      if (!field.IsKnown(of)) continue;
      text += fmt::format("mocapd_{}{} {}\n", metric.name, Braced(label_of(of), metric.label),
                          metric.scale * NumberOf(field.value(of)));
    }
  }
}

std::string CameraLabel(const ReportedCamera& camera) {
  return fmt::format("camera=\"{}\"", camera.name);
}
std::string StageLabel(const StageTiming& timing) {
  return fmt::format("stage=\"{}\"", NameOf(timing.stage));
}
std::string SenderLabel(const KeypointSender& sender) { return "sender=" + JsonText(sender.name); }
std::string NoLabel(const ServiceReport&) { return {}; }

}  // namespace

std::string MetricsText(const ServiceReport& report) {
  std::string text;
  AddMetrics(ServiceFields(), std::span(&report, 1), NoLabel, text);
  AddMetrics(StageFields(), report.now.recent.all, StageLabel, text);
  AddMetrics(CameraFields(), CamerasOf(report), CameraLabel, text);
  AddMetrics(KeypointFields(), report.keypoints.senders, SenderLabel, text);
  return text;
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

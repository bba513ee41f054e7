// Metrics for Prometheus, in a text file that its node exporter collects.
#pragma once

#include <filesystem>
#include <string>

#include "daemon/status/service_report.h"

namespace mocap {

/// The report in Prometheus' text format.
std::string MetricsText(const ServiceReport& report);

/// Replaces a file by this text atomically. @return whether that succeeded.
bool WriteMetrics(const std::filesystem::path& file, const std::string& text);

}  // namespace mocap

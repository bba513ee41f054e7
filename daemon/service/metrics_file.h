// Figures for Prometheus, by way of a text file that its node exporter collects.
#pragma once

#include <filesystem>
#include <string>

#include "daemon/status/service_report.h"

namespace mocap {

/// The report in Prometheus' text format.
std::string MetricsText(const ServiceReport& report);

/// Puts such a text into a file in one step. @return whether that worked.
bool WriteMetrics(const std::filesystem::path& file, const std::string& text);

}  // namespace mocap

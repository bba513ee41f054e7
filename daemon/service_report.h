// How the whole service does, and whether that is good.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/recording.h"
#include "daemon/status_window.h"

namespace mocap {

/// How well the body fits at the moment.
struct Fit {
  double residual_mm = 0;  ///< Meaningful while tracking.
  int voxels = 0;
};

/// Everything that is told of the service when somebody asks.
struct ServiceReport {
  StatusReport now;
  Fit fit;
  std::string studio;
  double fps_nominal = 0;
  std::string lcm_url;
  std::int64_t up_ns = 0;  ///< Since the start.
  RecordingStatus recording;
};

/// Says what is not as it should be and what helps, the worst first; empty when all is good.
std::vector<std::string> Complaints(const ServiceReport& report);

/// One line for people: the state, rate, latency, cameras, and the first complaint.
std::string ReportLine(const ServiceReport& report);
/// A page for people.
std::string ReportText(const ServiceReport& report);
/// One JSON object.
std::string ReportJson(const ServiceReport& report);

}  // namespace mocap

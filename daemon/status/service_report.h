// How the whole service does, and whether that is good.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "daemon/recording/cut_off_takes.h"
#include "daemon/recording/recording.h"
#include "daemon/status/channel_status.h"
#include "daemon/status/followed_person.h"
#include "daemon/status/light_watch.h"
#include "daemon/status/node_report.h"
#include "daemon/status/status_window.h"

namespace mocap {

/// How well the body fits at the moment.
struct Fit {
  double residual_mm = 0;  ///< Meaningful while tracking.
  int voxels = 0;
};

/// Something that was made once and gets old: the calibration, the pictures of the empty studio.
struct Made {
  std::string where;        ///< A file or folder, or what else it comes from.
  std::int64_t made_s = 0;  ///< Since the Unix epoch; 0: unknown.
};

/// The fate of messages: sent, failed, not received.
struct Delivery {
  std::string problem;  ///< Why they cannot be sent at present; empty: they can.
  ChannelStatus channel;
};

/// Everything that is told of the service when somebody asks.
struct ServiceReport {
  StatusReport now;
  Fit fit;
  std::vector<FollowedPerson> people;  ///< In the order of their numbers.
  std::int64_t people_ns = 0;          ///< When that was, by the steady clock.
  std::string studio;
  double fps_nominal = 0;
  std::vector<double> camera_fps;  ///< Of those that have their own; 0 or none: fps_nominal.
  std::string lcm_url;
  std::int64_t epoch_s = 0;  ///< When this was.
  std::int64_t up_ns = 0;    ///< Since the start.
  Made calibration;
  Made background;
  std::optional<LightChange> light_change;
  RecordingStatus recording;
  std::filesystem::path takes;  ///< Where recordings go.
  std::int64_t bytes_free = 0;  ///< There.
  double keep_free_mb = 0;
  std::string takes_problem;       ///< Why none can be written there; empty: they can.
  std::string metrics_problem;     ///< The file of figures that cannot be written.
  std::int64_t disk_stall_ns = 0;  ///< How long the disk has been asked and has not answered.
  bool log_fails = false;          ///< Messages are lost.
  std::int64_t age_ns = 0;         ///< How long ago this was, when somebody asks.
  Delivery delivery;
  std::vector<CutOffTake> cut_off;
  std::string node;   ///< The name of this node; empty: it is none.
  NodesReport nodes;  ///< Of a studio.
};

/// One line for people: the state, rate, latency, cameras, and the first complaint.
std::string ReportLine(const ServiceReport& report);
/// A page for people.
std::string ReportText(const ServiceReport& report);
/// What the cameras see of the empty studio, when that was learned, and in what light.
std::string BackgroundText(const ServiceReport& report);
/// One JSON object.
std::string ReportJson(const ServiceReport& report);

}  // namespace mocap

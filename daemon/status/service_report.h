// The status of the whole service, and whether it is good.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "daemon/pipeline/keypoint_status.h"
#include "daemon/recording/cut_off_takes.h"
#include "daemon/recording/recording.h"
#include "daemon/status/channel_status.h"
#include "daemon/status/followed_person.h"
#include "daemon/status/light_watch.h"
#include "daemon/status/moved_furniture.h"
#include "daemon/status/node_report.h"
#include "daemon/status/status_window.h"
#include "daemon/status/studio_link.h"

namespace mocap {

/// The present fit of the body.
struct Fit {
  double residual_mm = 0;  ///< Meaningful while tracking.
  int voxels = 0;
};

/// Something that was made once and ages: the calibration, the background.
struct Made {
  std::string where;        ///< A file, folder or other origin.
  std::int64_t made_s = 0;  ///< Since the Unix epoch; 0: unknown.
};

/// What happens to messages: sent, failed, not received.
struct Delivery {
  std::string problem;  ///< Why they cannot be sent now; empty: they can.
  ChannelStatus channel;
};

/// Everything that the service reports on request.
struct ServiceReport {
  std::string version = MOCAP_VERSION;
  StatusReport now;
  Fit fit;
  std::vector<FollowedPerson> people;  ///< Sorted by number.
  std::int64_t people_ns = 0;          ///< Time of `people`, by the steady clock.
  std::string studio;
  double fps_nominal = 0;
  std::vector<double> camera_fps;  ///< Of each camera; 0 or absent: fps_nominal.
  std::string lcm_url;
  std::int64_t epoch_s = 0;  ///< Time of this report.
  std::int64_t up_ns = 0;    ///< Since the start.
  Made calibration;
  std::string calibration_fault;  ///< Why it cannot be right; empty: nothing is known against it.
  std::int64_t nobody_ns = 0;     ///< How long nobody has been tracked; 0: somebody is.
  Made background;
  std::optional<LightChange> light_change;
  std::vector<MovedFurniture> moved;  ///< By camera.
  RecordingStatus recording;
  std::filesystem::path takes;        ///< Folder for recordings.
  std::filesystem::path takes_place;  ///< The same, or its nearest existing parent.
  std::int64_t bytes_free = 0;        ///< In that folder.
  double keep_free_mb = 0;
  std::string takes_problem;       ///< Why takes cannot be written; empty: they can.
  std::string metrics_problem;     ///< Why the metrics file cannot be written.
  std::int64_t disk_stall_ns = 0;  ///< How long the disk has not answered a request.
  bool log_fails = false;          ///< Log messages are lost.
  std::int64_t age_ns = 0;         ///< Age of the report when it is requested.
  Delivery delivery;
  std::vector<CutOffTake> cut_off;
  std::string node;                ///< The name of this node; empty: not a node.
  std::optional<StudioLink> link;  ///< Of a node with its studio.
  NodesReport nodes;               ///< A studio's nodes.
  KeypointsReport keypoints;
  /// Diagnostics of the mocapd that sent this report; empty: it is of this one.
  std::optional<std::vector<std::string>> told;
};

/// How many cameras deliver frames.
int Streaming(const PipelineStatus& status);
/// One line: state, rate, latency, cameras, and the first diagnostic.
std::string ReportLine(const ServiceReport& report);
/// A page of text.
std::string ReportText(const ServiceReport& report);
/// Whether all is good, and otherwise each diagnostic on a line.
std::string ConclusionText(const ServiceReport& report);
/// How many sets there are, and how long each stage takes.
std::string SetsText(const ServiceReport& report);
/// The background's origin and age, and the present light.
std::string BackgroundText(const ServiceReport& report);
/// One JSON object.
std::string ReportJson(const ServiceReport& report);

}  // namespace mocap

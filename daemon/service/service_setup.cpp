#include "daemon/service/service_setup.h"

#include <utility>

#include "config/load_config.h"
#include "config/open_studio.h"
#include "core/calibration/camera_places.h"
#include "core/errors.h"
#include "core/make_motion_capture.h"
#include "daemon/base/other_program.h"
#include "daemon/base/service_folders.h"
#include "daemon/control/control_socket.h"
#include "daemon/messages/open_lcm.h"
#include "daemon/pipeline/realtime.h"
#include "drivers/quoted.h"
#include "drivers/take/take_layout.h"

namespace mocap {
namespace {

Made MadeBy(const std::filesystem::path& file) { return {file.string(), WrittenAt(file)}; }

/// A calibration may contain its date, which a copy keeps.
Made CalibrationMadeBy(const std::filesystem::path& file) {
  Made made = MadeBy(file);
  const CalibrationRecord record = LoadCalibrationRecord(file);
  if (record.made_s != 0) made.made_s = record.made_s;
  return made;
}

Made CalibrationOf(const Config& config) {
  if (config.source.driver == "take")
    return CalibrationMadeBy(TakeLayout{config.source.take}.Calibration());
  if (IsLive(config.source) || config.role == Role::kStudio)
    return CalibrationMadeBy(config.calibration);
  return {"the simulated studio's own", 0};
}

/// The folder must exist already: the collector of the metrics makes it.
void RequireMetricsPlace(const std::filesystem::path& file) {
  if (file.empty()) return;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    throw SetupError(
        "metrics.file is " + file.string() + ", and " + folder.string() +
        " is not a folder; expected the folder of the node exporter's textfile collector");
  }
  if (std::filesystem::is_directory(file, error)) {
    throw SetupError("metrics.file is " + file.string() + ", which is a folder; expected a file");
  }
  if (const std::string why = WhyNotWritable(folder); !why.empty()) {
    throw SetupError("metrics.file is " + file.string() + ", which cannot be written: " + why);
  }
}

void RequireNodePrograms(const std::vector<StudioNode>& nodes) {
  for (const StudioNode& node : nodes) {
    if (node.control.empty() || IsProgram(node.control.front())) continue;
    throw SetupError("nodes: control of the node " + Quoted(node.name) + " begins with " +
                     Quoted(node.control.front()) +
                     ", which is no program here; expected a program's path or its name in PATH, "
                     "such as \"ssh\"");
  }
}

void RequireTakesPlace(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  if (const std::string why = WhyNotWritable(folder); !why.empty()) {
    throw SetupError("recording.folder is " + folder.string() +
                     ", which cannot be written: " + why);
  }
}

PreparedService Prepare(const Config& config) {
  RequirePlaces(config);
  PreparedService prepared;
  prepared.body = LoadBodyTable(config.body);
  RequireBodyOf(config.tracker, prepared.body);
  prepared.studio = OpenStudio(config);
  RequireCameraCount(prepared.studio);
  if (ControlSocketOf(config.service.control.socket).empty()) {
    prepared.studio.remarks.push_back(
        "there is no control socket, so mocap status, record and the like cannot ask this mocapd: "
        "set [control] socket, or XDG_RUNTIME_DIR");
  }
  return prepared;
}

}  // namespace

void RequirePlaces(const Config& config) {
  RequireMetricsPlace(config.service.metrics.file);
  RequireTakesPlace(config.service.recording.folder);
  RequireNodePrograms(config.nodes);
}

std::filesystem::path ControlPlaceOf(const Config& config) {
  const std::filesystem::path socket = ControlSocketOf(config.service.control.socket);
  if (!socket.empty()) RequireSocketPlace(socket);
  return socket;
}

PreparedService PrepareService(const Config& config) {
  PrepareRealtime(config.service.realtime);
  std::unique_ptr<lcm::LCM> lcm = OpenLcm(config.lcm.url);
  PreparedService prepared = Prepare(config);
  prepared.lcm = std::move(lcm);
  prepared.preview_lcm = OpenLcmBeside(config.lcm.url);
  return prepared;
}

std::vector<std::string> CheckConfig(const Config& config) {
  ControlPlaceOf(config);
  PrepareRealtime(config.service.realtime);
  CheckLcm(config.lcm.url);
  const PreparedService prepared = Prepare(config);
  // Simulated pictures cannot be wrong, and rendering takes time.
  if (config.source.driver != "simulated")
    LearnBackgrounds(prepared.studio.cameras, config.segmentation);
  return prepared.studio.remarks;
}

PipelineOptions PipelineOptionsFor(const Config& config, std::vector<std::deque<FrameTap>*> taps) {
  // A recording that is read at full speed has old times, and can wait.
  const bool can_wait = config.source.driver == "take" && config.source.rate == ReplayRate::kFast;
  return {.segmentation = config.segmentation,
          .voxel_mm = config.voxel_mm,
          .overflow = can_wait ? Overflow::kWait : Overflow::kDropOldest,
          .latency_origin = can_wait ? LatencyOrigin::kArrival : LatencyOrigin::kCapture,
          .tracker = config.tracker,
          .people = config.people,
          .priority = can_wait ? 0 : FramePathPriority(config.service.realtime),
          .processors = config.service.realtime.processors,
          .taps = std::move(taps)};
}

KnownBackgrounds KnownBackgroundsOf(const Studio& studio) {
  std::vector<BackgroundSource> sources;
  for (const StudioCamera& camera : studio.cameras)
    if (camera.driver) sources.push_back(camera.background);
  return KnownBackgrounds(std::move(sources));
}

RecordedStudio RecordedStudioOf(const Studio& studio, const KnownBackgrounds& known,
                                const std::string& config_text) {
  RecordedStudio recorded{.name = studio.name,
                          .fps_nominal = studio.fps_nominal,
                          .cameras = {},
                          .config_text = config_text,
                          .times = studio.times};
  for (std::size_t i = 0; i < studio.cameras.size() && studio.cameras[i].driver; ++i) {
    // The background at the time of the recording, not the present one.
    const auto read = [&known, i](const BackgroundSource::Visit& visit) {
      known.Of(i).ForEach(visit);
    };
    recorded.cameras.push_back({studio.cameras[i].calibration, BackgroundSource::OneByOne(read)});
  }
  return recorded;
}

TruthError TruthFor(const SourceConfig& source) {
  if (source.driver != "simulated") return {};
  return SimulatedTruthError(LiveSimulation(source));
}

Made BackgroundOf(const Config& config) {
  if (config.source.driver == "take") return {"the take's own", 0};
  if (config.source.driver == "none") return {"that of each node", 0};
  if (!IsLive(config.source)) return {"the simulated studio's own", 0};
  return MadeBy(config.background);
}

LearningPlace LearningPlaceFor(const Config& config, const Studio& studio) {
  LearningPlace place{.cameras = {}, .folder = config.background, .refusal = {}};
  for (const StudioCamera& camera : studio.cameras) {
    if (!camera.driver) break;
    place.cameras.push_back(camera.calibration);
    if (!camera.calibration.head || !place.refusal.empty()) continue;
    place.refusal = camera.calibration.name +
                    " is on a pan-tilt head, which has to scan its range: stop mocapd, then run "
                    "mocap background learn --config FILE";
  }
  if (!IsLive(config.source)) {
    place.refusal = "source.driver is \"" + config.source.driver +
                    "\", which has its own pictures of the empty studio";
  }
  return place;
}

ServiceReport ReportAbout(const Config& config, const Studio& studio) {
  ServiceReport report;
  report.studio = studio.name;
  report.fps_nominal = studio.fps_nominal;
  for (const StudioCamera& camera : studio.cameras) report.camera_fps.push_back(camera.fps);
  report.lcm_url = config.lcm.url;
  report.node = config.node.name;
  report.calibration = CalibrationOf(config);
  const std::vector<Finding> findings = CheckPlaces(CalibrationsOf(studio), true);
  if (!findings.empty() && findings.front().severity == Severity::kWrong)
    report.calibration_fault = findings.front().text;
  report.background = BackgroundOf(config);
  return report;
}

}  // namespace mocap

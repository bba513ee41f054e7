#include "daemon/service/service_setup.h"

#include <chrono>
#include <utility>

#include "config/load_config.h"
#include "config/open_studio.h"
#include "drivers/take/take_layout.h"

namespace mocap {
namespace {

/// When a file was written last, since the Unix epoch; 0 where there is none.
std::int64_t WrittenAt(const std::filesystem::path& file) {
  std::error_code error;
  const auto time = std::filesystem::last_write_time(file, error);
  if (error) return 0;
  const auto since = std::chrono::file_clock::to_sys(time).time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(since).count();
}

Made MadeBy(const std::filesystem::path& file) { return {file.string(), WrittenAt(file)}; }

/// A calibration may tell when it was made: a copy is no younger.
Made CalibrationMadeBy(const std::filesystem::path& file) {
  Made made = MadeBy(file);
  const CalibrationRecord record = LoadCalibrationRecord(file);
  if (record.made_s != 0) made.made_s = record.made_s;
  return made;
}

Made CalibrationOf(const Config& config) {
  if (config.source.driver == "take")
    return CalibrationMadeBy(TakeLayout{config.source.take}.Calibration());
  if (IsLive(config.source)) return CalibrationMadeBy(config.calibration);
  return {"the simulated studio's own", 0};
}

}  // namespace

PipelineOptions PipelineOptionsFor(const Config& config, std::vector<std::deque<FrameTap>*> taps) {
  // A recording that is read as fast as it can be has old times, and can wait.
  const bool can_wait = config.source.driver == "take" && config.source.rate == ReplayRate::kFast;
  return {.segmentation = config.segmentation,
          .voxel_mm = config.voxel_mm,
          .overflow = can_wait ? Overflow::kWait : Overflow::kDropOldest,
          .latency_origin = can_wait ? LatencyOrigin::kArrival : LatencyOrigin::kCapture,
          .priority = config.service.realtime.priority,
          .processors = config.service.realtime.processors,
          .taps = std::move(taps)};
}

KnownBackgrounds KnownBackgroundsOf(const Studio& studio) {
  std::vector<BackgroundSource> sources;
  for (const StudioCamera& camera : studio.cameras) sources.push_back(camera.background);
  return KnownBackgrounds(std::move(sources));
}

RecordedStudio RecordedStudioOf(const Studio& studio, const KnownBackgrounds& known,
                                const std::string& config_text) {
  RecordedStudio recorded{.name = studio.name,
                          .fps_nominal = studio.fps_nominal,
                          .cameras = {},
                          .config_text = config_text,
                          .times = studio.times};
  for (std::size_t i = 0; i < studio.cameras.size(); ++i) {
    // What is known by the time of the recording, not now.
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
  if (!IsLive(config.source)) return {"the simulated studio's own", 0};
  return MadeBy(config.background);
}

LearningPlace LearningPlaceFor(const Config& config, const Studio& studio) {
  LearningPlace place{.cameras = {}, .folder = config.background, .refusal = {}};
  for (const StudioCamera& camera : studio.cameras) {
    place.cameras.push_back(camera.calibration);
    if (!camera.calibration.head || !place.refusal.empty()) continue;
    place.refusal = camera.calibration.name +
                    " turns, which takes its time: stop mocapd, then mocap background learn "
                    "--config FILE";
  }
  if (!IsLive(config.source)) {
    place.refusal = "source.driver is \"" + config.source.driver +
                    "\", which brings its own pictures of the empty studio";
  }
  return place;
}

ServiceReport ReportAbout(const Config& config, const Studio& studio) {
  ServiceReport report;
  report.studio = studio.name;
  report.fps_nominal = studio.fps_nominal;
  for (const StudioCamera& camera : studio.cameras) report.camera_fps.push_back(camera.fps);
  report.lcm_url = config.lcm.url;
  report.calibration = CalibrationOf(config);
  return report;
}

}  // namespace mocap

#include "config/open_studio.h"

#include <algorithm>
#include <utility>

#include "config/load_config.h"
#include "config/open_live.h"
#include "config/room_limits.h"
#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"

namespace mocap {

SimulatedStudioOptions LiveSimulation(const SourceConfig& source) {
  SimulatedStudioOptions options;
  options.motion = source.motion;
  options.people = source.people;
  options.stature_mm = source.stature_mm;
  options.fps = source.fps;
  options.cameras = source.cameras;
  options.width_px = source.width_px;
  options.height_px = source.height_px;
  options.seed = source.seed;
  options.losses_per_minute = source.losses_per_minute;
  options.pan_tilt = options.follow = source.follow;
  options.realtime = true;
  return options;
}

std::vector<CameraCalibration> CalibrationsOf(const Studio& studio) {
  std::vector<CameraCalibration> calibrations;
  for (const StudioCamera& camera : studio.cameras) calibrations.push_back(camera.calibration);
  return calibrations;
}

namespace {

Studio OpenTakeAsSource(const Config& config) {
  const SourceConfig& source = config.source;
  if (!IsThere(source.take))
    throw SetupError(WhereOf(config, "source.take") + " is " + source.take.string() +
                     ", which is not there; expected the folder of a take");
  TakeOptions options{.rate = source.rate,
                      .loop = source.loop,
                      .in_memory = source.in_memory,
                      .cameras = config.node.cameras};
  // Nodes that replay the same take are in step.
  if (config.role == Role::kNode) options.begin_ns = [] { return std::int64_t{0}; };
  Studio studio = OpenTake(source.take, options);
  RequireRoom(CalibrationsOf(studio), config.voxel_mm,
              TakeLayout{source.take}.Calibration().string());
  return studio;
}

/// Keeps the named cameras, in that order; all if none is named.
void Keep(const std::vector<std::string>& names, Studio& studio) {
  if (names.empty()) return;
  std::vector<StudioCamera> kept;
  for (const std::string& name : names) {
    const auto camera = std::ranges::find_if(studio.cameras, [&](const StudioCamera& c) {
      return c.driver && c.calibration.name == name;
    });
    if (camera == studio.cameras.end()) {
      std::vector<std::string> there;
      for (const StudioCamera& one : studio.cameras) {
        if (one.driver) there.push_back(one.calibration.name);
      }
      throw SetupError("node.cameras has " + Quoted(name) + ", and " + studio.name +
                       " has no such camera; " + ExpectedNames(name, there));
    }
    kept.push_back(std::move(*camera));
  }
  studio.cameras = std::move(kept);
}

Studio OpenOwnCameras(const Config& config) {
  const SourceConfig& source = config.source;
  if (source.driver == "none") return {"studio", source.fps, {}};
  if (source.driver == "take") return OpenTakeAsSource(config);
  if (IsLive(source)) {
    Studio studio = OpenLiveStudio(config);
    RequireRoom(CalibrationsOf(studio), config.voxel_mm, config.calibration.string());
    return studio;
  }
  Studio studio = OpenSimulatedStudio(LiveSimulation(source));
  Keep(config.node.cameras, studio);
  return studio;
}

/// Adds the nodes' cameras, which have no drivers here.
void AddNodes(const Config& config, Studio& studio) {
  const std::vector<CameraCalibration> calibrations = LoadCalibration(config.calibration);
  for (const StudioNode& node : config.nodes) {
    for (const std::string& name : node.cameras) {
      const auto camera = std::ranges::find(calibrations, name, &CameraCalibration::name);
      if (camera == calibrations.end()) {
        throw SetupError(config.calibration.string() + ": cameras." + name +
                         " is missing, but node " + node.name + " has it");
      }
      studio.cameras.push_back({*camera, nullptr, {}});
    }
  }
  RequireRoom(CalibrationsOf(studio), config.voxel_mm, config.calibration.string());
}

}  // namespace

Studio OpenStudio(const Config& config) {
  Studio studio = OpenOwnCameras(config);
  if (config.role == Role::kStudio) AddNodes(config, studio);
  if (config.role == Role::kStudio || IsLive(config.source))
    RemarkOnPlaces(LoadCalibration(config.calibration), config.calibration, studio);
  return studio;
}

}  // namespace mocap

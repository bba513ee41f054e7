#include "config/open_studio.h"

#include "config/open_live.h"
#include "config/room_limits.h"
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

Studio OpenStudio(const Config& config) {
  const SourceConfig& source = config.source;
  if (source.driver == "take") {
    Studio studio = OpenTake(
        source.take,
        {.rate = source.rate, .loop = source.loop, .in_memory = source.in_memory, .cameras = {}});
    RequireRoom(CalibrationsOf(studio), config.voxel_mm,
                TakeLayout{source.take}.Calibration().string());
    return studio;
  }
  if (!IsLive(source)) return OpenSimulatedStudio(LiveSimulation(source));
  Studio studio = OpenLiveStudio(config);
  RequireRoom(CalibrationsOf(studio), config.voxel_mm, config.calibration.string());
  return studio;
}

}  // namespace mocap

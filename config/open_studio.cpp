#include "config/open_studio.h"

#include "config/open_live.h"

namespace mocap {

SimulatedStudioOptions LiveSimulation(const SourceConfig& source) {
  SimulatedStudioOptions options;
  options.motion = source.motion;
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

Studio OpenStudio(const Config& config) {
  const SourceConfig& source = config.source;
  if (source.driver == "take") {
    return OpenTake(source.take, {.rate = source.rate,
                                  .loop = source.loop,
                                  .in_memory = source.in_memory,
                                  .cameras = {}});
  }
  if (IsLive(source)) return OpenLiveStudio(config);
  return OpenSimulatedStudio(LiveSimulation(source));
}

}  // namespace mocap

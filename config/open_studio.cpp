#include "config/open_studio.h"

#include "core/errors.h"

namespace mocap {

SimulatedStudioOptions LiveSimulation(const SourceConfig& source) {
  SimulatedStudioOptions options;
  options.motion = source.motion;
  options.stature_mm = source.stature_mm;
  options.fps = source.fps;
  options.cameras = source.cameras;
  options.seed = source.seed;
  options.realtime = true;
  return options;
}

Studio OpenStudio(const Config& config) {
  const SourceConfig& source = config.source;
  if (source.driver == "take") {
    return OpenTake(source.take, {.rate = source.rate, .loop = source.loop, .cameras = {}});
  }
  if (source.driver == "simulated") return OpenSimulatedStudio(LiveSimulation(source));
  throw SetupError("source.driver is \"" + source.driver +
                   "\", which this build lacks; \"take\" or \"simulated\" is wanted");
}

}  // namespace mocap

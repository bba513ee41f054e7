#include "drivers/virtual_studio/studio_options.h"

namespace mocap {

SimulatedStudioOptions RecordedSimulation() {
  SimulatedStudioOptions options;
  options.start_ns = 1'000'000'000'000;
  return options;
}

}  // namespace mocap

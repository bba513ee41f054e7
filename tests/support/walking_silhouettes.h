// What the cameras of the simulated studio truly see of somebody who walks.
#pragma once

#include <chrono>
#include <vector>

#include "core/reconstruction/silhouette/silhouette.h"
#include "drivers/simulation/simulated_studio.h"

namespace mocap::testing {

struct WalkingSilhouettes {
  std::vector<CameraCalibration> cameras;
  std::vector<std::vector<Silhouette>> moments;  ///< By moment, a second apart, then by camera.
};

/// Ten seconds, made once.
inline const WalkingSilhouettes& WalkOfTenSeconds() {
  static const WalkingSilhouettes walk = [] {
    SimulatedStudioOptions options = RecordedSimulation();
    options.fps = 1;
    options.seconds = 10;
    options.seed = 2;
    const SimulatedStudio studio(options);
    WalkingSilhouettes made{studio.cameras(), std::vector<std::vector<Silhouette>>(10)};
    for (std::size_t c = 0; c < made.cameras.size(); ++c) {
      const auto camera = studio.OpenCamera(static_cast<int>(c));
      camera->Start();
      for (std::vector<Silhouette>& moment : made.moments) {
        Frame frame;
        camera->Grab(frame, std::chrono::milliseconds(0));
        moment.push_back(camera->TrueSilhouette());
      }
    }
    return made;
  }();
  return walk;
}

}  // namespace mocap::testing

// The settings requested from every live camera, independent of its driver.
#pragma once

#include <string>

namespace mocap {

struct CameraRequest {
  std::string device;  ///< As the configuration names it.
  /// Picture size; 0: the camera's default.
  int width_px = 0, height_px = 0;
  double fps = 30;
};

}  // namespace mocap

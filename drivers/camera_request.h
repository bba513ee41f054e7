// What every live camera is asked for, whatever its driver.
#pragma once

#include <string>

namespace mocap {

struct CameraRequest {
  std::string device;  ///< As the configuration names it.
  /// Size of its pictures; 0: as the camera comes.
  int width_px = 0, height_px = 0;
  double fps = 30;
};

}  // namespace mocap

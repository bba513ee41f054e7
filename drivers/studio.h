// The cameras of a studio as one source, with what tracking needs to know about each.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "drivers/camera_driver.h"

namespace mocap {

/// One camera with its calibration and the way to its picture of the empty studio.
struct StudioCamera {
  CameraCalibration calibration;
  std::unique_ptr<CameraDriver> driver;
  /// Gives the frames of the empty studio; read once, before the driver starts.
  std::function<std::vector<BackgroundFrame>()> background;
};

/// All cameras, in the order in which the pipeline numbers them.
struct Studio {
  std::string name;
  double fps_nominal = 30;
  std::vector<StudioCamera> cameras;
};

}  // namespace mocap

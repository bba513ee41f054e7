// The cameras of a studio as one source, with what tracking needs to know about each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "drivers/background_source.h"
#include "drivers/camera_driver.h"
#include "drivers/subject_position.h"

namespace mocap {

/// One camera with its calibration and the way to its picture of the empty studio.
struct StudioCamera {
  CameraCalibration calibration;
  std::unique_ptr<CameraDriver> driver;  ///< Null: it is at another computer.
  BackgroundSource background;  ///< Read before the driver starts.
  double fps = 0;               ///< Of its own; 0: the studio's.
  std::string waits_for = "";   ///< The camera that triggers it; empty: none that is known.
};

/// Which clock the capture times of a studio's frames are of.
enum class CaptureTimes {
  kPresent,  ///< The program's timeline.
  kRecorded  ///< That of the recording, which is read as fast as possible.
};

/// All cameras, in the order in which the pipeline numbers them: those with drivers come first.
struct Studio {
  std::string name;
  double fps_nominal = 30;
  std::vector<StudioCamera> cameras;
  /// To be told where the person is; null: no head follows.
  std::shared_ptr<SubjectPosition> person = nullptr;
  CaptureTimes times = CaptureTimes::kPresent;
  /// What whoever opened it should know, a line each.
  std::vector<std::string> remarks = {};
};

}  // namespace mocap

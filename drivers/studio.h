// The cameras of a studio as one source, with the data that tracking needs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "drivers/background_source.h"
#include "drivers/camera_driver.h"
#include "drivers/subject_position.h"

namespace mocap {

/// A camera with its calibration and the source of its background.
struct StudioCamera {
  CameraCalibration calibration;
  std::unique_ptr<CameraDriver> driver;  ///< Null: connected to another computer.
  BackgroundSource background;           ///< Read before the driver starts.
  double fps = 0;                        ///< Its own rate; 0: the studio's.
  std::string waits_for = "";            ///< The camera that triggers it; empty: none known.
};

/// The clock of a studio's capture times.
enum class CaptureTimes {
  kPresent,  ///< The program's timeline.
  kRecorded  ///< The recording's; it is read as fast as possible.
};

/// All cameras, in the pipeline's numbering: cameras with drivers come first.
struct Studio {
  std::string name;
  double fps_nominal = 30;
  std::vector<StudioCamera> cameras;
  /// Receives the subject position; null: no head follows.
  std::shared_ptr<SubjectPosition> person = nullptr;
  CaptureTimes times = CaptureTimes::kPresent;
  /// Remarks for the user, one line each.
  std::vector<std::string> remarks = {};
};

}  // namespace mocap

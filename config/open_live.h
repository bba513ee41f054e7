// Live cameras: from [[cameras]] to drivers.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "core/reconstruction/camera/camera_model.h"
#include "drivers/camera_driver.h"
#include "drivers/camera_request.h"
#include "drivers/pan_tilt.h"
#include "drivers/studio.h"
#include "drivers/subject_position.h"

namespace mocap {

/// One of [[cameras]], its driver not started yet.
struct LiveCamera {
  std::string name;
  CameraRequest request;
  std::optional<CameraCalibration> calibration;
  std::unique_ptr<CameraDriver> driver;
  PanTilt* head = nullptr;  ///< The driver's; null: it has none.
  PanTiltLimits range;      ///< How far the studio lets it turn, beside its own limits.
  std::string waits_for;    ///< The camera that triggers it; empty: none that is known.
};

/// Makes the drivers of all live cameras. A studio may be looked at before it is calibrated:
/// without the calibration's file, cameras come without one.
/// @param person       where he will be told to be, for the heads that follow; null: none does.
/// @throws SetupError  when source.driver is no live one, the calibration has no camera of a name,
/// or its pictures another size.
std::vector<LiveCamera> OpenLiveCameras(const Config& config,
                                        const std::shared_ptr<SubjectPosition>& person = nullptr);

/// Opens all live cameras with their calibration and their pictures of the empty studio.
/// @throws SetupError  also when one of these is missing.
Studio OpenLiveStudio(const Config& config);

}  // namespace mocap

// Opens live cameras: from [[cameras]] to drivers.
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

/// One of [[cameras]]; its driver is not started yet.
struct LiveCamera {
  std::string name;
  CameraRequest request;
  std::optional<CameraCalibration> calibration;
  std::unique_ptr<CameraDriver> driver;
  PanTilt* head = nullptr;  ///< Owned by the driver; null: none.
  PanTiltLimits range;      ///< Range that the studio permits, besides the head's own limits.
  std::string waits_for;    ///< The camera that triggers it; empty: none known.
};

/// Creates the drivers of all live cameras. Without a calibration file, cameras have no
/// calibration, so that a studio can be viewed before it is calibrated.
/// @param person       source of the subject position, for heads that follow; null: none follows.
/// @throws SetupError  if source.driver is not a live one, or the calibration lacks a camera or has
/// another picture size for it.
std::vector<LiveCamera> OpenLiveCameras(const Config& config,
                                        const std::shared_ptr<SubjectPosition>& person = nullptr);

/// Opens all live cameras with their calibrations and backgrounds.
/// @throws SetupError  also if one of these is missing.
Studio OpenLiveStudio(const Config& config);

}  // namespace mocap

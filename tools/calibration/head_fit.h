// Pan-tilt heads from views of boards that lie still while the camera turns.
#pragma once

#include <span>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/detections.h"

namespace mocap {

struct PanTiltFit {
  PanTiltHead head;
  double rms_px = 0;
  int views = 0;
};

/// Finds both axes, a point on each and the encoders' scales.
///
/// @param camera     with its lens and its pose, which stay.
/// @param posed_at   what the encoders read where that pose holds: pan = tilt = 0 of the head.
/// @param detections  of this camera; boards of one moment number are at one place, wherever that
/// is.
/// @throws SetupError  naming the camera: too few views, too little turning, or views that no head
/// explains.
PanTiltFit FitHead(const CameraCalibration& camera, const PanTiltAngles& posed_at,
                   const Board& board, std::span<const BoardDetection> detections);

/// Gives what a camera's encoders read while it was posed.
/// @throws SetupError  when the head turned meanwhile.
PanTiltAngles StandingAngles(const std::string& camera, std::span<const PanTiltAngles> readings);

}  // namespace mocap

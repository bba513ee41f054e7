// Calibrates pan-tilt heads from views of still boards while the camera turns.
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

/// Fits both axes, a point on each, and the encoders' scales.
///
/// @param camera     with its intrinsics and pose, which are fixed.
/// @param posed_at   encoder readings for that pose: pan = tilt = 0 of the head.
/// @param detections  of this camera; boards of one moment number have the same, unknown pose.
/// @throws SetupError  naming the camera: too few views, too little turning, or views that no head
/// explains.
PanTiltFit FitHead(const CameraCalibration& camera, const PanTiltAngles& posed_at,
                   const Board& board, std::span<const BoardDetection> detections);

/// Returns a camera's encoder readings during the recording that gave its pose.
/// @throws SetupError  when the head turned meanwhile.
PanTiltAngles StandingAngles(const std::string& camera, std::span<const PanTiltAngles> readings);

}  // namespace mocap

// Pan-tilt heads from views of boards that lie still while the camera turns.
#pragma once

#include <span>

#include "core/reconstruction/camera_model.h"
#include "tools/calibration/sightings.h"

namespace mocap {

struct HeadFit {
  PanTiltHead head;
  /// True angle over the encoder's. An offset needs no number of its own: it is part of where the
  /// axes and the camera are at the encoder's zero.
  double pan_scale = 1, tilt_scale = 1;
  double rms_px = 0;
  int views = 0;
};

/// Finds both axes, a point on each and the encoders' scales.
///
/// @param camera     with its lens and its pose at pan = tilt = 0, which stay.
/// @param sightings  of this camera; boards of one moment number are at one place, wherever that
/// is.
/// @throws SetupError  naming the camera: too few views, too little turning, or views that no head
/// explains.
HeadFit FitHead(const CameraCalibration& camera, const Board& board,
                std::span<const BoardSighting> sightings);

}  // namespace mocap

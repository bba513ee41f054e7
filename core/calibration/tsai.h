// §4: calibration of a camera by the method of R. Y. Tsai, "A versatile camera calibration
// technique for high-accuracy 3D machine vision metrology using off-the-shelf TV cameras and
// lenses", IEEE Journal of Robotics and Automation 3(4), 1987.
#pragma once

#include <span>

#include "core/geometry.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// A known point and where it is seen.
struct PointDetection {
  Vector3 p_W;  ///< [mm].
  Vector2 pixel;
};

/// The sensor as known before calibration.
struct TsaiSensor {
  Vector2 pitch_mm = Vector2::Zero();   ///< dx, dy.
  Vector2 center_px = Vector2::Zero();  ///< Where the axis is supposed to meet the picture.
  double sx = 1;                        ///< Taken as it is for coplanar points.
  /// The axis is refined with all else in the last step; otherwise it stays.
  bool refine_center = true;
};

struct TsaiCalibration {
  TsaiLens lens;
  RigidTransform X_CW;
  bool coplanar = false;
  double mean_px = 0;  ///< Mean distance between points projected and seen.
  double rms_px = 0;
  double worst_px = 0;
};

/// Calibrates lens and pose from points whose places are known.
///
/// Stage 1 takes rotation, Tx and Ty (and sx where points are not coplanar) from the radial
/// alignment constraint, which holds whatever the radial distortion; stage 2 takes f and Tz
/// linearly, then with κ1; last, everything that the points determine is refined together on
/// distances in the picture, points being distorted through the cubic of Tsai's model. Points count
/// as coplanar when they lie within a thousandth of their extent of a plane; sx is then not
/// determined and stays as given.
///
/// @throws SetupError  with the reason, when the points do not determine a camera: fewer than 8
/// (coplanar) or 10, all on a line, a plane parallel to the picture (f and Tz cannot be told
/// apart), or a mirrored set.
TsaiCalibration CalibrateTsai(std::span<const PointDetection> points, const TsaiSensor& sensor);

}  // namespace mocap

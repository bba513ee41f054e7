// §4: calibration of a camera by the method of R. Y. Tsai, "A versatile camera calibration
// technique for high-accuracy 3D machine vision metrology using off-the-shelf TV cameras and
// lenses", IEEE Journal of Robotics and Automation 3(4), 1987.
#pragma once

#include <span>

#include "core/geometry.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// A known point and its detection in the picture.
struct PointDetection {
  Vector3 p_W;  ///< [mm].
  Vector2 pixel;
};

/// The sensor as known before calibration.
struct TsaiSensor {
  Vector2 pitch_mm = Vector2::Zero();   ///< dx, dy.
  Vector2 center_px = Vector2::Zero();  ///< Nominal point where the axis meets the picture.
  double sx = 1;                        ///< Used as given for coplanar points.
  /// Whether the last step refines the axis as well; otherwise it stays.
  bool refine_center = true;
};

struct TsaiCalibration {
  TsaiLens lens;
  RigidTransform X_CW;
  bool coplanar = false;
  double mean_px = 0;  ///< Mean distance between projected and detected points.
  double rms_px = 0;
  double worst_px = 0;
};

/// Calibrates lens and pose from points of known positions.
///
/// Stage 1 computes rotation, Tx and Ty (and sx for non-coplanar points) from the radial alignment
/// constraint, which holds for any radial distortion. Stage 2 computes f and Tz linearly, then with
/// κ1. Finally, everything that the points determine is refined together on distances in the
/// picture; points are distorted by the cubic of Tsai's model. Points count as coplanar if they lie
/// within a thousandth of their extent from a plane. Then sx is not determined and stays as given.
///
/// @throws SetupError  with the reason, if the points do not determine a camera: fewer than 8
/// (coplanar) or 10, all on a line, a plane parallel to the picture (f and Tz cannot be separated),
/// or a mirrored set.
TsaiCalibration CalibrateTsai(std::span<const PointDetection> points, const TsaiSensor& sensor);

}  // namespace mocap

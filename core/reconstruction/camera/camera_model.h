// §4: the camera. Lens models map between pixels and the undistorted sensor plane, divided by the
// focal length (Xu/f, Yu/f). The pose X_CW is separate, so that one lens serves every pan and tilt.
//
// Camera frame: x right, y down, z forward. Pixel centres lie at integers.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "core/geometry.h"

namespace mocap {

/// Tsai's lens (1987): Xu = Xd (1 + κ1 (Xd² + Yd²)); Xf = sx Xd / dx + Cx; Yf = Yd / dy + Cy. Mikić
/// et al. 2003, §4.
struct TsaiLens {
  double focal_mm = 0;
  double kappa1 = 0;  ///< [1/mm²], distorted -> undistorted.
  double sx = 1;
  Vector2 center_px = Vector2::Zero();
  Vector2 pitch_mm = Vector2::Zero();  ///< dx, dy.
};

/// OpenCV's pinhole with radial and tangential distortion, undistorted -> distorted. The radial
/// factor is (1 + k1 r² + k2 r⁴ + k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶).
struct OpenCvLens {
  Matrix3 K = Matrix3::Identity();     ///< [px].
  std::array<double, 8> distortion{};  ///< k1 k2 p1 p2 k3 k4 k5 k6.

  /// Tells whether k4, k5 or k6 is in use.
  bool IsRational() const { return distortion[5] != 0 || distortion[6] != 0 || distortion[7] != 0; }
};

/// OpenCV's fisheye (Kannala and Brandt, 2006).
struct FisheyeLens {
  Matrix3 K = Matrix3::Identity();     ///< [px].
  std::array<double, 4> distortion{};  ///< k1 k2 k3 k4.
};

using Lens = std::variant<TsaiLens, OpenCvLens, FisheyeLens>;

/// Maps undistorted sensor-plane coordinates (Xu/f, Yu/f) to a pixel. Empty where the lens does not
/// show this direction (its radius has turned back).
std::optional<Vector2> PixelFromNormalized(const Lens& lens, const Vector2& normalized);

/// Maps a pixel to undistorted sensor-plane coordinates (Xu/f, Yu/f); the inverse of
/// PixelFromNormalized.
std::optional<Vector2> NormalizedFromPixel(const Lens& lens, const Vector2& pixel);

/// Returns how far from the axis a lens sees, as a length of (Xu/f, Yu/f). At most tan of 85°:
/// beyond, the sensor plane no longer represents directions.
double FieldRadius(const Lens& lens);

/// Angles of a pan-tilt head at the moment of exposure, as its encoders read [rad].
struct PanTiltAngles {
  double pan_rad = 0;
  double tilt_rad = 0;
  friend bool operator==(const PanTiltAngles&, const PanTiltAngles&) = default;
};

/// A pan-tilt head: its two axes at pan = tilt = 0, in the world frame, and its encoder
/// calibration. The axes need not pass through the lens.
struct PanTiltHead {
  Vector3 pan_axis_W = Vector3::UnitZ();
  Vector3 pan_point_W = Vector3::Zero();
  Vector3 tilt_axis_W = Vector3::UnitX();
  Vector3 tilt_point_W = Vector3::Zero();
  /// Ratio of the true angle to the encoder's.
  double pan_scale = 1, tilt_scale = 1;
  /// Encoder readings at pan = tilt = 0.
  PanTiltAngles zero{};
};

/// One calibrated camera.
struct CameraCalibration {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  Lens lens;
  RigidTransform X_CW;              ///< At pan = tilt = 0.
  std::optional<PanTiltHead> head;  ///< Only for a camera on a pan-tilt head.

  /// Returns the pose for given encoder readings: X_CW M⁻¹ with M = M_pan M_tilt. Without a
  /// pan-tilt head it is X_CW.
  RigidTransform PoseAt(const PanTiltAngles& readings) const;
};

}  // namespace mocap

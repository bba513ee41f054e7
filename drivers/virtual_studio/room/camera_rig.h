// Poses and lenses of the simulated studio's cameras.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap::simulation {

struct RigOptions {
  int cameras = 6;
  int width_px = 640, height_px = 480;
  bool pan_tilt = false;
  std::uint64_t seed = 1;
  double height_mm = 2550;                ///< In the mean; each hangs up to 250 mm higher or lower.
  double arc_rad = 2 * std::numbers::pi;  ///< Part of the circle along which cameras are spread.
};

/// Places cameras along the walls, facing the middle. They have Tsai lenses with strong distortion
/// and are named cam1, cam2, …. With heads: longer lenses, the axes beside the lens.
std::vector<CameraCalibration> HangCameras(const RigOptions& options);

/// Returns the angles that bring a point to the middle of the lens, in whole encoder steps.
PanTiltAngles AimInSteps(const CameraCalibration& camera, const Vector3& p_W);

}  // namespace mocap::simulation

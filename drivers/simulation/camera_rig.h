// Where the simulated studio's cameras hang and what lenses they have.
#pragma once

#include <cstdint>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap::simulation {

struct RigOptions {
  int cameras = 6;
  int width_px = 640, height_px = 480;
  bool pan_tilt = false;
  std::uint64_t seed = 1;
};

/// Hangs cameras along the walls, 2.3 to 2.8 m high, looking at the middle, with Tsai lenses that
/// distort strongly; named cam1, cam2, …. With heads: longer lenses, the axes beside the lens.
std::vector<CameraCalibration> HangCameras(const RigOptions& options);

/// Turns a head so that a point comes to the middle of the lens, in whole steps of its encoder.
PanTiltAngles AimInSteps(const CameraCalibration& camera, const Vector3& p_W);

}  // namespace mocap::simulation

#include "drivers/virtual_studio/room/camera_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/reconstruction/camera/head_aim.h"
#include "drivers/virtual_studio/random.h"
#include "drivers/virtual_studio/room/room_plan.h"

namespace mocap::simulation {
namespace {

// 16 bits per turn: 0.1 mrad, a twentieth of a pixel.
constexpr double kEncoderStep_rad = 2 * std::numbers::pi / 65536;

Matrix3 LookingAt(const Vector3& from_W, const Vector3& to_W, double roll) {
  const Vector3 forward = (to_W - from_W).normalized();
  const Vector3 right = forward.cross(Vector3::UnitZ()).normalized();
  Matrix3 R_CW;
  R_CW << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return Eigen::AngleAxisd(roll, Vector3::UnitZ()).toRotationMatrix() * R_CW;
}

Vector3 Slightly(Random& random, double size) {
  return {random.Uniform(-size, size), random.Uniform(-size, size), random.Uniform(-size, size)};
}

}  // namespace

std::vector<CameraCalibration> HangCameras(const RigOptions& options) {
  Random random(Mix(options.seed, Tag("rig")));
  std::vector<CameraCalibration> rig;
  const double first = random.Uniform(0.1, 0.9);
  for (int i = 0; i < options.cameras; ++i) {
    const double angle =
        options.arc_rad * (i + first + random.Uniform(-0.12, 0.12)) / options.cameras;
    // From the middle to the wall, less the mount.
    const Vector2 out(std::cos(angle), std::sin(angle));
    const double inset = random.Uniform(150, 280);
    const double wall_mm = std::min((kRoomX_mm / 2 - inset) / std::max(std::abs(out.x()), 1e-9),
                                    (kRoomY_mm / 2 - inset) / std::max(std::abs(out.y()), 1e-9));
    const Vector3 p_WC(wall_mm * out.x(), wall_mm * out.y(),
                       random.Uniform(options.height_mm - 250, options.height_mm + 250));
    const Vector3 target = random.UniformIn({-120, 120}, {-120, 120}, {820, 980});
    CameraCalibration camera;
    camera.name = "cam" + std::to_string(i + 1);
    camera.width_px = options.width_px;
    camera.height_px = options.height_px;
    TsaiLens lens;
    const double zoom = options.pan_tilt ? 1.3 : 1;
    // A nearer camera has a shorter focal length.
    lens.focal_mm = zoom * (4.5 + 0.9 * std::clamp((wall_mm - 3000) / 1300, 0.0, 1.0) +
                            random.Uniform(-0.15, 0.15));
    lens.kappa1 = random.Uniform(0.0020, 0.0036);
    lens.sx = random.Uniform(0.99, 1.01);
    lens.center_px = Vector2((options.width_px - 1) / 2.0, (options.height_px - 1) / 2.0) +
                     options.width_px / 640.0 * random.UniformIn({-6, 6}, {-6, 6});
    lens.pitch_mm = Vector2(0.0100, 0.0099) * 640.0 / options.width_px;
    camera.lens = lens;
    const double roll = options.pan_tilt ? 0 : random.Uniform(-0.026, 0.026);
    const Matrix3 R_CW = LookingAt(p_WC, target, roll);
    camera.X_CW = {R_CW, -R_CW * p_WC};
    if (options.pan_tilt) {
      PanTiltHead head;
      head.pan_axis_W = (Vector3::UnitZ() + Slightly(random, 0.002)).normalized();
      head.tilt_axis_W = (R_CW.row(0).transpose() + Slightly(random, 0.002)).normalized();
      const Vector2 pan = random.UniformIn({30, 50}, {40, 60});
      head.pan_point_W = p_WC - R_CW.row(2).transpose() * pan.x() - Vector3(0, 0, pan.y());
      const Vector2 tilt = random.UniformIn({25, 45}, {2, 8});
      head.tilt_point_W =
          p_WC - R_CW.row(2).transpose() * tilt.x() + R_CW.row(1).transpose() * tilt.y();
      camera.head = head;
    }
    rig.push_back(camera);
  }
  return rig;
}

PanTiltAngles AimInSteps(const CameraCalibration& camera, const Vector3& p_W) {
  const auto rounded = [](double angle_rad) {
    return std::round(angle_rad / kEncoderStep_rad) * kEncoderStep_rad;
  };
  const PanTiltAngles angles = AimAt(camera, p_W);
  return {rounded(angles.pan_rad), rounded(angles.tilt_rad)};
}

}  // namespace mocap::simulation

// Pictures of a chessboard as a camera sees it.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/board.h"

namespace mocap::testing {

/// Paints the board with a white rim of one square on a grey room, 3 x 3 samples a pixel.
inline Image<Bgr> PaintBoard(const CameraCalibration& camera, const RigidTransform& X_CB,
                             const Board& board) {
  Image<Bgr> image(camera.width_px, camera.height_px, Bgr{120, 120, 120});
  const RigidTransform X_BC = X_CB.Inverse();
  const Vector3 eye_B = X_BC.p;
  const auto brightness = [&](const Vector2& pixel) {
    const auto n = NormalizedFromPixel(camera.lens, pixel);
    if (!n) return 120.0;
    const Vector3 ray_B = X_BC.R * n->homogeneous();
    const double along = -eye_B.z() / ray_B.z();
    if (!(along > 0)) return 120.0;
    // In squares; the first inner corner is at 0, 0.
    const double x = (eye_B.x() + along * ray_B.x()) / board.square_mm;
    const double y = (eye_B.y() + along * ray_B.y()) / board.square_mm;
    if (x < -2 || y < -2 || x > board.columns + 1 || y > board.rows + 1) return 120.0;
    if (x < -1 || y < -1 || x > board.columns || y > board.rows) return 225.0;
    const int parity = static_cast<int>(std::floor(x) + std::floor(y));
    return parity % 2 == 0 ? 35.0 : 225.0;
  };
  // Sampling is slow and most of the room is grey.
  Eigen::AlignedBox2d around;
  for (const double x : {-2.0, board.columns + 1.0}) {
    for (const double y : {-2.0, board.rows + 1.0}) {
      const Vector3 p_C = X_CB * (board.square_mm * Vector3(x, y, 0));
      around.extend(*PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z()));
    }
  }
  const auto within = [](double v, int size) { return std::clamp(static_cast<int>(v), 0, size); };
  for (int y = within(around.min().y() - 15, image.height());
       y < within(around.max().y() + 15, image.height()); ++y) {
    for (int x = within(around.min().x() - 15, image.width());
         x < within(around.max().x() + 15, image.width()); ++x) {
      double sum = 0;
      for (int s = 0; s < 9; ++s)
        sum += brightness({x + (s % 3 - 1) / 3.0, y + (s / 3 - 1) / 3.0}) / 9;
      const auto value = static_cast<std::uint8_t>(std::lround(sum));
      image(x, y) = {value, value, value};
    }
  }
  return image;
}

}  // namespace mocap::testing

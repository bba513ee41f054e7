// Pictures of boards as a camera sees them.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/board.h"

namespace mocap::testing {

/// Paints a rectangle of the board's plane, given in mm, before a grey room; 3 x 3 samples a pixel.
/// @param brightness  of a point of the rectangle [mm].
template <typename Brightness>
Image<Bgr> PaintPlane(const CameraCalibration& camera, const RigidTransform& X_CB,
                      const Eigen::AlignedBox2d& sheet, const Brightness& brightness) {
  constexpr double kRoom = 120;
  Image<Bgr> image(camera.width_px, camera.height_px, Bgr{120, 120, 120});
  const RigidTransform X_BC = X_CB.Inverse();
  const Vector3 eye_B = X_BC.p;
  const auto sample = [&](const Vector2& pixel) {
    const auto n = NormalizedFromPixel(camera.lens, pixel);
    if (!n) return kRoom;
    const Vector3 ray_B = X_BC.R * n->homogeneous();
    const double along = -eye_B.z() / ray_B.z();
    if (!(along > 0)) return kRoom;
    const Vector2 at = eye_B.head<2>() + along * ray_B.head<2>();
    return sheet.contains(at) ? brightness(at) : kRoom;
  };
  // Sampling is slow and most of the room is grey.
  Eigen::AlignedBox2d around;
  for (int corner = 0; corner < 4; ++corner) {
    const Vector2 at = sheet.corner(static_cast<Eigen::AlignedBox2d::CornerType>(corner));
    const Vector3 p_C = X_CB * Vector3(at.x(), at.y(), 0);
    around.extend(*PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z()));
  }
  const auto within = [](double v, int size) { return std::clamp(static_cast<int>(v), 0, size); };
  for (int y = within(around.min().y() - 15, image.height());
       y < within(around.max().y() + 15, image.height()); ++y) {
    for (int x = within(around.min().x() - 15, image.width());
         x < within(around.max().x() + 15, image.width()); ++x) {
      double sum = 0;
      for (int s = 0; s < 9; ++s) sum += sample({x + (s % 3 - 1) / 3.0, y + (s / 3 - 1) / 3.0}) / 9;
      const auto value = static_cast<std::uint8_t>(std::lround(sum));
      image(x, y) = {value, value, value};
    }
  }
  return image;
}

/// Paints a chessboard with a white rim of one square.
inline Image<Bgr> PaintBoard(const CameraCalibration& camera, const RigidTransform& X_CB,
                             const Board& board) {
  const Vector2 last(board.columns, board.rows);
  const Eigen::AlignedBox2d squares(Vector2(-1, -1), last);
  const Eigen::AlignedBox2d sheet(board.square_mm * Vector2(-2, -2),
                                  board.square_mm * (last + Vector2(1, 1)));
  return PaintPlane(camera, X_CB, sheet, [&](const Vector2& at_mm) {
    // In squares; the first inner corner is at 0, 0.
    const Vector2 at = at_mm / board.square_mm;
    if (!squares.contains(at)) return 225.0;
    const int parity = static_cast<int>(std::floor(at.x()) + std::floor(at.y()));
    return parity % 2 == 0 ? 35.0 : 225.0;
  });
}

}  // namespace mocap::testing

// A chessboard in the simulated studio: its motion, and its picture.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap::simulation {

/// The only board: 8 x 5 inner corners, squares of 100 mm, a white rim.
struct PrintedBoard {
  static constexpr int kColumns = 8, kRows = 5;
  static constexpr double kSquare_mm = 100;

  /// p_BQ of the middle of all inner corners [mm], from the first one; x along a row, y along a
  /// column, z into the board.
  static Vector3 Middle() {
    return {(kColumns - 1) * kSquare_mm / 2, (kRows - 1) * kSquare_mm / 2, 0};
  }
};

/// The board moves from place to place and rests briefly at each.
inline constexpr double kMoveBoard_s = 1.6, kHoldBoard_s = 0.4;

/// Carries the board through a studio. One of three places is in front of a camera, each in turn;
/// two are somewhere in the room, where several cameras see it. X_WB is a smooth function of time.
/// Reentrant.
class BoardPath {
 public:
  BoardPath(const std::vector<CameraCalibration>& cameras, std::uint64_t seed);
  RigidTransform PoseAt(double t_s) const;

 private:
  RigidTransform PlaceOf(std::uint64_t number) const;

  std::vector<CameraCalibration> cameras_;
  std::uint64_t seed_;
};

/// Returns X_WB of the board face up on the floor, with the first corner at the origin and the rows
/// along x.
RigidTransform BoardOnFloor();

/// Returns X_WB of the board on a tilted desk where all cameras see it.
/// @param place  each number gives another place.
RigidTransform BoardOnDesk(std::uint64_t seed, int place);

/// Paints the board over a picture of the empty studio. Nearer objects hide it.
/// @param nearness  of the empty studio: 1 / z_C [1/mm].
void PaintBoard(const CameraCalibration& camera, const RigidTransform& X_CW,
                const RigidTransform& X_WB, const Image<float>& nearness, Image<Bgr>& canvas);

}  // namespace mocap::simulation

// A chessboard in the simulated studio: how it is carried about, and what a camera sees of it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap::simulation {

/// The only board there is: 8 x 5 inner corners and squares of 100 mm, with a white rim.
struct PrintedBoard {
  static constexpr int kColumns = 8, kRows = 5;
  static constexpr double kSquare_mm = 100;

  /// p_BQ from the first inner corner to the middle of all [mm]; x along a row, y down the columns,
  /// z into the board.
  static Vector3 Middle() {
    return {(kColumns - 1) * kSquare_mm / 2, (kRows - 1) * kSquare_mm / 2, 0};
  }
};

/// The board is brought from one place to the next, and held there for a moment.
inline constexpr double kMoveBoard_s = 1.6, kHoldBoard_s = 0.4;

/// Carries the board through a studio: of three places one is before a camera, each in turn, and
/// two are somewhere in the room, where several see it. X_WB is a smooth function of time.
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

/// Gives X_WB of the board face up on the floor, its first corner at the origin and its rows along
/// x.
RigidTransform BoardOnFloor();

/// Gives X_WB of the board on a tilted desk in the room, where all cameras see it.
/// @param place  each number is another.
RigidTransform BoardOnDesk(std::uint64_t seed, int place);

/// Paints the board over a picture of the empty studio, behind what stands before it.
/// @param nearness  of the empty studio: 1 / z_C [1/mm].
void PaintBoard(const CameraCalibration& camera, const RigidTransform& X_CW,
                const RigidTransform& X_WB, const Image<float>& nearness, Image<Bgr>& canvas);

}  // namespace mocap::simulation

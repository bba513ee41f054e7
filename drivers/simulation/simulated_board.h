// Footage for calibrating: a chessboard instead of a person in the simulated studio.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/image.h"
#include "drivers/simulation/simulated_studio.h"

namespace mocap {

enum class BoardPlace { kCarried, kOnFloor, kOnDesk };

/// What the cameras see of a board of 8 x 5 inner corners and squares of 100 mm. Heads stand at
/// zero, but look about a board on a desk. The same options give the same pictures. Thread-bound.
class SimulatedBoard {
 public:
  /// @param options  motion and stature do not matter.
  /// @throws SetupError  when the options cannot be.
  /// @param desk  each number is another place; only of a board on a desk.
  SimulatedBoard(const SimulatedStudioOptions& options, BoardPlace place, int desk = 0);
  ~SimulatedBoard();

  const std::vector<CameraCalibration>& cameras() const;
  std::int64_t CaptureTime(int camera, std::int64_t frame) const;
  /// X_WB at a time, of the board's frame: its first inner corner, rows along x, z into the board.
  RigidTransform PoseAt(std::int64_t capture_ns) const;
  PanTiltAngles AnglesAt(int camera, std::int64_t capture_ns) const;
  /// Paints what a camera sees; valid until the next call.
  ImageView<const Bgr> Paint(int camera, std::int64_t frame);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap

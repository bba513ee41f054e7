// Calibration footage: a chessboard in place of a person in the simulated studio.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "drivers/virtual_studio/studio_options.h"

namespace mocap {

enum class BoardPlace { kCarried, kOnFloor, kOnDesk };

/// Pictures of a board of 8 x 5 inner corners and squares of 100 mm. Heads stay at zero, but scan
/// around a board on a desk. The same options give the same pictures. Thread-bound.
class SimulatedBoard {
 public:
  /// @param options  motion and stature have no effect.
  /// @param desk     each number gives another place; only for a board on a desk.
  /// @throws SetupError  for invalid options.
  SimulatedBoard(const SimulatedStudioOptions& options, BoardPlace place, int desk = 0);
  ~SimulatedBoard();

  const std::vector<CameraCalibration>& cameras() const;
  std::int64_t CaptureTime(int camera, std::int64_t frame) const;
  /// Returns X_WB at a time; the board's frame is at its first inner corner, x along the rows, z
  /// into the board.
  RigidTransform PoseAt(std::int64_t capture_ns) const;
  PanTiltAngles AnglesAt(int camera, std::int64_t capture_ns) const;
  /// Paints a camera's picture; valid until the next call.
  ImageView<const Bgr> Paint(int camera, std::int64_t frame);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap

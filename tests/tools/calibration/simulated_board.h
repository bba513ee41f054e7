// Detections of a board carried through a simulated studio, with truth.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "drivers/virtual_studio/room/camera_rig.h"
#include "tools/calibration/detections.h"

namespace mocap::testing {

/// Cameras of a simulated studio, hung a little differently with each seed.
inline std::vector<CameraCalibration> SeededRig(unsigned seed) {
  simulation::RigOptions options;
  options.seed = seed;
  return simulation::HangCameras(options);
}

struct BoardWalk {
  Board board{BoardKind::kChessboard, 8, 5, 100, "", 0, false};
  int moments = 150;
  double noise_px = 0.15;
  double room_mm = 3600;  ///< Side of the square that the board is carried over.
  unsigned seed = 1;
};

/// Where a printed board faces: its z points into it, so that a camera before it has z < 0.
inline std::optional<BoardCorners> SeeBoard(const CameraCalibration& camera,
                                            const RigidTransform& X_CW, const RigidTransform& X_WB,
                                            const Board& board, double noise_px,
                                            std::mt19937& random) {
  std::normal_distribution<double> noise(0, noise_px > 0 ? noise_px : 1);
  const RigidTransform X_CB = X_CW * X_WB;
  const Vector3 towards_B = -(X_CB.Inverse() * Vector3::Zero()).normalized();
  // Too slanted or from behind, no detector finds it.
  if (-towards_B.z() > -std::cos(70 * std::numbers::pi / 180)) return std::nullopt;
  BoardCorners corners;
  for (int id = 0; id < board.corners(); ++id) {
    const Vector3 p_C = X_CB * board.Corner(id);
    if (p_C.z() < 300) return std::nullopt;
    const auto pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
    if (!pixel || pixel->minCoeff() < 8 || pixel->x() > camera.width_px - 9 ||
        pixel->y() > camera.height_px - 9)
      return std::nullopt;
    corners.ids.push_back(id);
    corners.pixels.push_back(noise_px > 0 ? Vector2(*pixel + Vector2(noise(random), noise(random)))
                                          : *pixel);
  }
  return corners;
}

/// A pose at which a person might hold the board: between knee and head, facing any way.
inline RigidTransform CarriedBoard(const BoardWalk& walk, std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1, 1);
  const double heading = std::numbers::pi * u(random);
  const double up = 0.5 + 0.5 * u(random);  // Tilted towards the ceiling, where cameras hang.
  const Vector3 into =
      -Vector3(std::cos(heading) * std::cos(up), std::sin(heading) * std::cos(up), std::sin(up));
  const Vector3 right = Vector3::UnitZ().cross(into).normalized() * -1.0;
  Matrix3 R;
  R << right, into.cross(right), into;
  const Matrix3 R_WB = R * ExpRotation({0, 0, 0.6 * u(random)});
  const Vector3 middle(walk.room_mm / 2 * u(random), walk.room_mm / 2 * u(random),
                       1050 + 550 * u(random));
  const Vector3 corner = (walk.board.Corner(walk.board.corners() - 1)) / 2;
  return {R_WB, middle - R_WB * corner};
}

inline BoardDetections DetectionsFor(const std::vector<CameraCalibration>& cameras,
                                     const Board& board) {
  BoardDetections detections;
  detections.board = board;
  for (const CameraCalibration& camera : cameras)
    detections.cameras.push_back({camera.name, camera.width_px, camera.height_px, 0, ""});
  return detections;
}

/// Carries the board about. A third of the moments is spent near each camera in turn, as a person
/// does who fills the picture.
inline BoardDetections WalkBoard(const std::vector<CameraCalibration>& cameras,
                                 const BoardWalk& walk) {
  std::mt19937 random(walk.seed);
  BoardDetections detections = DetectionsFor(cameras, walk.board);
  for (int moment = 0; moment < walk.moments; ++moment) {
    RigidTransform X_WB = CarriedBoard(walk, random);
    if (moment % 3 == 0) {
      const CameraCalibration& camera = cameras[moment / 3 % cameras.size()];
      std::uniform_real_distribution<double> u(-1, 1);
      const Vector3 p_C = Vector3(0.6 * u(random), 0.45 * u(random), 1) * (1500 + 500 * u(random));
      const Matrix3 tilt = ExpRotation(Vector3(0.6 * u(random), 0.6 * u(random), u(random)));
      const Vector3 corner = walk.board.Corner(walk.board.corners() - 1) / 2;
      X_WB = camera.X_CW.Inverse() * RigidTransform{tilt, p_C - tilt * corner};
    }
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      auto corners = SeeBoard(cameras[c], cameras[c].X_CW, X_WB, walk.board, walk.noise_px, random);
      if (!corners) continue;
      BoardDetection s;
      s.camera = static_cast<int>(c);
      s.moment = moment;
      s.corners = *corners;
      s.name = "frame " + std::to_string(moment);
      detections.detections.push_back(s);
    }
  }
  detections.moments = walk.moments;
  return detections;
}

inline BoardDetections SeeStillBoard(const std::vector<CameraCalibration>& cameras,
                                     const Board& board, const RigidTransform& X_WB,
                                     double noise_px) {
  std::mt19937 random(99);
  BoardDetections detections = DetectionsFor(cameras, board);
  detections.moments = 1;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    auto corners = SeeBoard(cameras[c], cameras[c].X_CW, X_WB, board, noise_px, random);
    if (!corners) continue;
    BoardDetection s;
    s.camera = static_cast<int>(c);
    s.corners = *corners;
    detections.detections.push_back(s);
  }
  return detections;
}

}  // namespace mocap::testing

// The world's floor, origin and axes, and its scale.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/bundle.h"
#include "tools/calibration/detections.h"

namespace mocap {

/// Gives the transform from the bundle's world to one whose floor is the board's plane: origin at
/// the board's first corner, x along its rows, z up to the side where the cameras are.
/// @param thickness_mm  the printed side lies so high above the floor.
RigidTransform WorldOnBoard(const RigidTransform& X_WB,
                            const std::vector<CameraCalibration>& cameras, double thickness_mm);

/// Finds where a board that lies still is, by the cameras that see it.
/// @throws SetupError  naming the camera that contradicts the others, when the error exceeds 3 px.
RigidTransform FindStillBoard(const BoardDetections& still,
                              const std::vector<CameraCalibration>& cameras);

/// Three points on the floor as cameras see them: the origin, one on the x axis, one on the side of
/// y.
struct FloorPoint {
  int camera = 0;
  int point = 0;  ///< 0 origin, 1 on x, 2 towards y.
  Vector2 pixel;
};

/// Gives the transform to the world that three floor points span.
/// @throws SetupError  when a point is seen by fewer than two cameras or the points lie on a line.
RigidTransform WorldOnPoints(const std::vector<FloorPoint>& points,
                             const std::vector<CameraCalibration>& cameras);

/// Reads `point,camera,x_px,y_px` rows, point being origin, x or y.
std::vector<FloorPoint> ReadFloorPoints(const std::string& file,
                                        const std::vector<CameraCalibration>& cameras);

/// Finds the point nearest to the rays of two pixels and more.
Vector3 Triangulate(const std::vector<std::pair<const CameraCalibration*, Vector2>>& seen);

/// Stretches the world about its origin, so that lengths agree with one that was measured.
void ScaleWorld(double factor, Bundle& bundle);

}  // namespace mocap

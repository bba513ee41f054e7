// The world's floor, origin, axes and scale.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/bundle.h"
#include "tools/calibration/detections.h"

namespace mocap {

/// Returns the transform from the bundle's world to one with its floor in the board's plane: origin
/// at the board's first corner, x along its rows, z up to the cameras' side.
/// @param thickness_mm  height of the printed side above the floor.
RigidTransform WorldOnBoard(const RigidTransform& X_WB,
                            const std::vector<CameraCalibration>& cameras, double thickness_mm);

/// Finds the pose of a still board from the cameras that see it.
/// @throws SetupError  naming the camera that contradicts the others, when the error exceeds 3 px.
RigidTransform FindStillBoard(const BoardDetections& still,
                              const std::vector<CameraCalibration>& cameras);

/// Observation of a floor point: the origin, a point on the x axis, or one on the side of y.
struct FloorPoint {
  int camera = 0;
  int point = 0;  ///< 0 origin, 1 on x, 2 towards y.
  Vector2 pixel;
};

/// Returns the transform to the world defined by three floor points.
/// @throws SetupError  when fewer than two cameras see a point, or the points are collinear.
RigidTransform WorldOnPoints(const std::vector<FloorPoint>& points,
                             const std::vector<CameraCalibration>& cameras);

/// Reads `point,camera,x_px,y_px` rows, point being origin, x or y.
std::vector<FloorPoint> ReadFloorPoints(const std::string& file,
                                        const std::vector<CameraCalibration>& cameras);

/// Finds the point nearest to the rays of two or more pixels.
Vector3 Triangulate(const std::vector<std::pair<const CameraCalibration*, Vector2>>& seen);

/// Scales the world about its origin, to match a measured length.
void ScaleWorld(double factor, Bundle& bundle);

}  // namespace mocap

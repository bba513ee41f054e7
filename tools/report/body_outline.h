// The tracked body projected into a camera: outlines of its parts, and a stick figure.
#pragma once

#include <optional>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/body_part.h"
#include "core/reconstruction/camera/camera_model.h"
#include "tools/results/result.h"

namespace mocap {

/// Side of the person. Different colours reveal swapped sides at once.
enum class BodySide { kMiddle, kLeft, kRight };

/// A closed or open line in the picture [px].
struct BodyLine {
  BodySide side = BodySide::kMiddle;
  std::vector<Vector2> pixels;
};

/// A bone of the stick figure.
struct Stick {
  Point from, to;
  BodySide side;
};
const std::vector<Stick>& Sticks();

/// Projects a point; empty if the camera cannot see it.
std::optional<Vector2> ProjectPoint(const CameraCalibration& camera, const RigidTransform& X_CW,
                                    const Vector3& p_WQ);

/// Outlines of the ten parts, with the sizes of the body: the torso is an elliptic cylinder, the
/// head an ellipsoid, the limbs are cylinders. Parts not entirely in front of the camera are
/// omitted.
std::vector<BodyLine> PartOutlines(const PoseRow& row, const BodySizes& sizes,
                                   const CameraCalibration& camera, const RigidTransform& X_CW);

/// The stick figure, one line of two pixels per bone.
std::vector<BodyLine> StickFigure(const PoseRow& row, const CameraCalibration& camera,
                                  const RigidTransform& X_CW);

}  // namespace mocap

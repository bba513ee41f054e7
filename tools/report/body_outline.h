// The tracked body as a camera would see it: outlines of its parts and a stick figure.
#pragma once

#include <optional>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/body_part.h"
#include "core/reconstruction/camera/camera_model.h"
#include "tools/results/result.h"

namespace mocap {

/// Which side of the person something belongs to; drawn in different colours, so that swapped sides
/// are seen at once.
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

/// Projects a point; empty where the camera cannot see it.
std::optional<Vector2> ProjectPoint(const CameraCalibration& camera, const RigidTransform& X_CW,
                                    const Vector3& p_WQ);

/// Outlines of the ten parts: the torso an elliptic cylinder, the head an ellipsoid, the limbs
/// cylinders, with the sizes of the body. Parts that are not wholly before the camera are left out.
std::vector<BodyLine> PartOutlines(const PoseRow& row, const BodySizes& sizes,
                                   const CameraCalibration& camera, const RigidTransform& X_CW);

/// The stick figure, a line of two pixels a bone.
std::vector<BodyLine> StickFigure(const PoseRow& row, const CameraCalibration& camera,
                                  const RigidTransform& X_CW);

}  // namespace mocap

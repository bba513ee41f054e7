// §4: one camera's contribution to a set.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "core/geometry.h"
#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Pose of a camera, and the table of its lens. Borrowed.
struct CameraEye {
  const SensorPlaneTable* table = nullptr;
  RigidTransform X_CW;

  /// Whether a point is in the picture.
  bool Sees(const Vector3& p_W) const {
    const Vector3 p_C = X_CW * p_W;
    return p_C.z() > 0 && table->Lookup(p_C.x() / p_C.z(), p_C.y() / p_C.z()).x >= 0;
  }
  /// Whether a person who fills a box is entirely in the picture. People are round: the middles of
  /// the box's vertical sides count, not its corners.
  bool SeesAllWithin(const Eigen::AlignedBox3d& box_W) const {
    const Vector3 middle_W = box_W.center(), half = box_W.sizes() / 2;
    for (const double up : {-half.z(), half.z()}) {
      for (const double side : {-1.0, 1.0}) {
        if (!Sees(middle_W + Vector3(side * half.x(), 0, up))) return false;
        if (!Sees(middle_W + Vector3(0, side * half.y(), up))) return false;
      }
    }
    return true;
  }
};

/// More than there are other cameras in a set.
inline constexpr int kNeverOutweighed = 64;

/// What one camera sees, and its pose at that moment. Borrowed for the call.
struct CarvingView {
  const SensorPlaneTable* table = nullptr;
  const Silhouette* silhouette = nullptr;
  RigidTransform X_CW;
  const Silhouette* unknown = nullptr;  ///< As in a trimap; null: no pixel is.
  /// How many others must show the person where this one calls it empty: from 1.
  int outweighed_by = kNeverOutweighed;

  /// Box around everything that may be a person; empty if no pixel shows one.
  std::optional<PixelBox> Box() const;
};

}  // namespace mocap

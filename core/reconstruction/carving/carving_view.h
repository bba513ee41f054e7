// §4: what one camera contributes to a set.
#pragma once

#include <Eigen/Geometry>

#include "core/geometry.h"
#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Where a camera stood, and what its lens shows. Borrowed.
struct CameraEye {
  const SensorPlaneTable* table = nullptr;
  RigidTransform X_CW;

  /// Whether all of a box is in the picture.
  bool SeesAll(const Eigen::AlignedBox3d& box_W) const {
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 p_C = X_CW * box_W.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      if (p_C.z() <= 0) return false;
      if (table->Lookup(p_C.x() / p_C.z(), p_C.y() / p_C.z()).x < 0) return false;
    }
    return true;
  }
};

/// One camera's outline and where the camera stood at that moment. Borrowed for the call.
struct CarvingView {
  const SensorPlaneTable* table = nullptr;
  const Silhouette* silhouette = nullptr;
  RigidTransform X_CW;
};

}  // namespace mocap

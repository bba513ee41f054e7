// §4: what one camera contributes to a set.
#pragma once

#include "core/geometry.h"
#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// One camera's outline and where the camera stood at that moment. Borrowed for the call.
struct CarvingView {
  const SensorPlaneTable* table = nullptr;
  const Silhouette* silhouette = nullptr;
  RigidTransform X_CW;
};

}  // namespace mocap

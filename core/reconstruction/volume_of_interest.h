// §4: where in the room the person can be, from the silhouettes' bounding boxes.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "core/reconstruction/carving_view.h"

namespace mocap {

/// Finds an upright box around the person, in the world frame [mm].
///
/// Each side of a silhouette's bounding box spans a plane with the camera's centre; the box is the
/// extent of what lies on the right side of all planes. A side gives no plane where the silhouette
/// runs out of the picture. The floor is at z = 0 with some tolerance; what no camera looks at
/// within a room's length is left out. Mikić et al. 2003, §4.
///
/// @return  empty when fewer than two silhouettes have pixels or their cones do not meet.
std::optional<Eigen::AlignedBox3d> FindVolumeOfInterest(std::span<const CarvingView> views);

}  // namespace mocap

// §4: where in the room the person can be, from the silhouettes' bounding boxes.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/carving/convex_volume.h"

namespace mocap {

/// Gives what a camera looks at within a room's length, above the floor, and some of what lies
/// beside [mm]. Nobody is looked for elsewhere.
Eigen::AlignedBox3d RoomBefore(const RigidTransform& X_CW);

/// Finds an upright box around the person, in the world frame [mm].
///
/// Each side of a silhouette's bounding box spans a plane with the camera's centre; the box is the
/// extent of what lies on the right side of all planes. A side gives no plane where the silhouette
/// runs out of the picture. The floor is at z = 0 with some tolerance; what no camera looks at
/// within a room's length is left out. Mikić et al. 2003, §4. Reuses its memory.
class VolumeOfInterest {
 public:
  /// @return  empty when fewer than two silhouettes have pixels or their cones do not meet.
  std::optional<Eigen::AlignedBox3d> Find(std::span<const CarvingView> views);

  /// The silhouettes' bounding boxes in the last set; empty where one has no pixels.
  const std::vector<std::optional<PixelBox>>& boxes() const { return boxes_; }

 private:
  ConvexVolume volume_;
  std::vector<std::optional<PixelBox>> boxes_;
};

}  // namespace mocap

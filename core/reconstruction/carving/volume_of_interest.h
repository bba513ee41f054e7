// §4: where in the room the person can be, from the silhouettes' bounding boxes.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/carving/convex_volume.h"

namespace mocap {

/// Returns the box that a camera views within a room's length, above the floor, with a margin [mm].
/// Nobody is searched for elsewhere.
Eigen::AlignedBox3d RoomBefore(const RigidTransform& X_CW);

/// Finds an axis-aligned box around the person, in the world frame [mm].
///
/// Each side of a silhouette's bounding box spans a plane with the camera's centre. The result is
/// the box around the intersection of all half-spaces. A side where the silhouette leaves the
/// picture gives no plane. The floor is at z = 0 with some tolerance. Places that no camera views
/// within a room's length are left out. Mikić et al. 2003, §4. Reuses its memory.
class VolumeOfInterest {
 public:
  /// @return  empty if fewer than two silhouettes have pixels, or if their cones do not intersect.
  std::optional<Eigen::AlignedBox3d> Find(std::span<const CarvingView> views);

  /// The silhouettes' bounding boxes in the last set; empty where one has no pixels.
  const std::vector<std::optional<PixelBox>>& boxes() const { return boxes_; }

 private:
  ConvexVolume volume_;
  std::vector<std::optional<PixelBox>> boxes_;
};

}  // namespace mocap

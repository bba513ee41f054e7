// §4: where in the room there can be flesh, from the silhouettes' bounding boxes.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/carving/volume_of_interest.h"

namespace mocap {

/// Finds the blocks of a room that may contain flesh.
///
/// A camera excludes what lies entirely in its picture and entirely beside the bounding box of its
/// silhouette. Each side of that box spans a plane with the camera's centre (Mikić et al. 2003,
/// §4). A camera does not decide about places outside its picture, because somebody else may be
/// there. Places that too few cameras see are excluded. The floor is at z = 0 with some tolerance.
/// Places that no camera views within a room's length are excluded. Reuses its memory.
class RoomBlocks {
 public:
  /// Side of a block [voxels].
  static constexpr int kBlock_voxels = 16;

  /// @param fewest  number of cameras that must see a place.
  /// @param within  limits the search [mm, world]; empty: the whole room.
  void Find(std::span<const CarvingView> views, int fewest, double voxel_mm,
            const Eigen::AlignedBox3d& within = {});

  /// First voxels of the blocks, relative to first_voxel(). If empty, there is nothing to see.
  const std::vector<Eigen::Vector3i>& blocks() const { return blocks_; }
  /// The smallest grid that contains all blocks, as far as they lie in the room. Voxels are counted
  /// from the world's origin.
  const Eigen::Vector3i& first_voxel() const { return first_voxel_; }
  const Eigen::Vector3i& size_voxels() const { return size_voxels_; }

 private:
  // A plane through a camera's centre; the inside of a window is where n · p + d >= 0.
  struct Plane {
    Vector3 n_W;
    double d;
    double reach;  // Reach of a cube, per mm of half its side.
  };
  using Cone = std::array<Plane, 4>;
  struct Eye {
    Plane ahead;
    Cone picture;      // Contains all that the camera sees,
    Cone all_picture;  // contains only what it sees,
    Cone box;          // and contains the silhouette.
    int outweighed_by;
  };

  static Plane PlaneOf(const RigidTransform& X_CW, const Vector3& normal_C);
  static Cone ConeOf(const RigidTransform& X_CW, const SensorPlaneTable::Window& window);
  void SetEyes(std::span<const CarvingView> views);
  void Visit(const Eigen::Vector3i& first, int side);
  bool MayHoldFlesh(const Vector3& middle_W, double half_mm) const;
  void FitGrid();

  std::vector<Eye> eyes_;
  int fewest_ = 0;
  double voxel_mm_ = 0;
  Eigen::Vector3i room_first_, room_size_;  // [voxels]
  std::vector<Eigen::Vector3i> blocks_;
  Eigen::Vector3i first_voxel_, size_voxels_;
};

}  // namespace mocap

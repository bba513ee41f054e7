// Beyond the paper: poses in which an unknown person may stand.
#pragma once

#include <vector>

#include "core/body/body_model.h"
#include "core/reconstruction/carving/voxel_cloud.h"

namespace mocap {

/// Everyday stances of one body, each with the centroid of its flesh. Stances are placed by the
/// centroid of all voxels. Hair, hats and clothes move it by centimetres, while a head or limb that
/// is searched for by its own shape may be something else.
class StanceLibrary {
 public:
  explicit StanceLibrary(const BodyModel& body);

  /// Appends every stance in all headings to `poses`.
  /// @param up_W  the trunk's axis, from pelvis to neck; unit length. Stances that lean forward
  /// lean away from it.
  void Propose(const Vector3& middle_W, const Vector3& up_W, std::vector<PoseState>& poses) const;

 private:
  struct Entry {
    JointAngles theta;
    Matrix3
        R_upright;  ///< Lean of the trunk: torso frame in the frame of a body that stands upright.
    Vector3 middle_T;  ///< Centroid of the flesh.
  };
  std::vector<Entry> entries_;
};

/// Returns the possible directions of a trunk: up, down, and along the voxels if they lean or lie.
std::vector<Vector3> TrunkAxes(const VoxelCloud& cloud);

}  // namespace mocap

// Beyond the paper: the poses in which somebody may stand whom nobody has seen before.
#pragma once

#include <vector>

#include "core/body/body_model.h"
#include "core/tracking/voxel_cloud.h"

namespace mocap {

/// Everyday stances of one body, each with the middle of its flesh. The middle of all voxels is
/// what a stance is hung up at: hair, hats and clothes shift it by centimetres, while a head or a
/// limb that is looked for by its own shape may be something else.
class StanceLibrary {
 public:
  explicit StanceLibrary(const BodyModel& body);

  /// Appends every stance, facing all around, to `poses`.
  /// @param up_W  the trunk's axis, from pelvis to neck; unit length. Stances that lean forward
  ///              lean away from it.
  void Propose(const Vector3& middle_W, const Vector3& up_W, std::vector<PoseState>& poses) const;

 private:
  struct Entry {
    JointAngles theta;
    Matrix3
        R_upright;     ///< How the trunk leans: torso frame in that of a body which stands upright.
    Vector3 middle_T;  ///< Of the flesh.
  };
  std::vector<Entry> entries_;
};

/// The directions in which a trunk may point: up, down, and along the voxels where those lean or
/// lie.
std::vector<Vector3> TrunkAxes(const VoxelCloud& cloud);

}  // namespace mocap

// §7.1: where the parts of a body lie that nobody has seen before: by fitting and growing, in one
// frame.
#pragma once

#include <optional>
#include <vector>

#include "core/tracking/template_fit.h"
#include "core/tracking/voxel_cloud.h"

namespace mocap {

/// A limb: a region of flesh that is left over when head and torso are taken away.
struct LimbBlob {
  std::vector<int> voxels;
  Vector3 root_W;   ///< Middle of its border with the torso: hip or shoulder.
  Vector3 joint_W;  ///< Far end of the grown upper arm or thigh.
  Vector3 tip_W;    ///< The end farthest from the root, along the limb.
};

struct LocalizedBody {
  HeadFit head;
  Cylinder torso;               ///< Anchored at the neck.
  std::vector<LimbBlob> limbs;  ///< At most four, the largest first.
  double height_mm = 0;         ///< Vertex above the lowest place.
};

/// Locates head, torso and limbs. Empty when there is nothing like a head above a torso. Figs. 10
/// and 11.
/// @param crust  of the head that is looked for.
std::optional<LocalizedBody> LocalizeBody(const VoxelCloud& cloud, const HeadCrust& crust);

}  // namespace mocap

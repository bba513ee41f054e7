// §7.1: body parts and their sizes in the first frame, without a prediction. Figs. 10 and 11.
#pragma once

#include <optional>

#include "core/body/body_sizes.h"
#include "core/mikic2003/cylinder.h"
#include "core/mikic2003/measured_points.h"
#include "core/tracking/voxel_cloud.h"

namespace mocap::mikic2003 {

/// A body in the first frame. Left and right are not distinguished yet (§7.3).
struct LocatedBody {
  LabeledFrame frame;
  BodySizes sizes;
  double height_less_head_mm = 0;
  Matrix3 R_WT;  ///< Of the torso; its x axis may point out of the back.
};

/// Locates head, torso and limbs. Fig. 11 (b)–(i).
/// @return  nothing if a part is not found: the next frame is then the first.
std::optional<LocatedBody> LocateBody(const VoxelCloud& cloud);

/// Fits the template of an average torso, then grows a small one there. Fig. 10 (a)–(d).
///
/// A grown section is elliptic. Its side lies along the longer axis of the average template's
/// voxels.
/// @param voxels  all voxels but the head's.
Cylinder GrowTorso(const VoxelCloud& cloud, std::span<const int> voxels, const Vector3& neck_W);

}  // namespace mocap::mikic2003

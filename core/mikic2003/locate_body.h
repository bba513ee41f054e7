// §7.1: body parts and their sizes without a prediction: in the first frame, and after loss of
// track. Figs. 10 and 11.
#pragma once

#include <optional>

#include "core/body/body_sizes.h"
#include "core/mikic2003/cylinder.h"
#include "core/mikic2003/measured_points.h"
#include "core/reconstruction/carving/voxel_cloud.h"

namespace mocap::mikic2003 {

/// A body without a prediction. Left and right are not distinguished yet (§7.3).
struct LocatedBody {
  LabeledFrame frame;
  BodySizes sizes;
  double height_less_head_mm = 0;
  Matrix3 R_WT;  ///< Of the torso; its x axis may point out of the back.
};

/// Locates head, torso and limbs. Fig. 11 (b)–(i).
///
/// What lies between the torso's template and the place where the legs part is labelled as torso.
/// The trunk's width and depth are bounded by those of people of that height.
/// @return  nothing if a part is not found.
std::optional<LocatedBody> LocateBody(const VoxelCloud& cloud);

/// Fits the template of an average torso, then grows a small one there. Fig. 10 (a)–(d).
///
/// A grown section is elliptic. Its side lies along the longer axis of the average template's
/// voxels.
/// @param voxels  all voxels but the head's.
Cylinder GrowTorso(const VoxelCloud& cloud, std::span<const int> voxels, const Vector3& neck_W);

}  // namespace mocap::mikic2003

// §6.2 and §7.1: the template that finds torso, upper arms and thighs.
#pragma once

#include <span>

#include "core/geometry.h"
#include "core/mikic2003/labels.h"
#include "core/reconstruction/carving/voxel_cloud.h"

namespace mocap::mikic2003 {

/// A cylinder with an elliptic section, anchored at the centre of its base.
struct Cylinder {
  Vector3 anchor_W;
  Vector3 axis_W;  ///< Unit vector from the anchor along the cylinder.
  Vector3 side_W;  ///< Unit vector perpendicular to the axis, along the section's `half_width_mm`.
  double length_mm;
  double half_width_mm;
  double half_depth_mm;

  bool Contains(const Vector3& p_WQ) const;
  Vector3 End() const { return anchor_W + length_mm * axis_W; }
  /// Turns the axis by the smallest rotation, and the side with it.
  void TurnTo(const Vector3& axis_W);
};

/// Returns a cylinder with a circular section.
Cylinder RoundCylinder(const Vector3& anchor_W, const Vector3& axis_W, double length_mm,
                       double radius_mm);

/// Returns a round template of the torso's larger width (§6.2), `rim_mm` wider on all sides; its
/// length stays.
Cylinder RoundWithRim(const Cylinder& torso, double rim_mm);

/// Returns those of the voxels that lie in the cylinder.
VoxelIndices VoxelsInside(const VoxelCloud& cloud, std::span<const int> voxels,
                          const Cylinder& cylinder);

/// Turns the cylinder about its anchor until its axis passes through the centroid of the voxels in
/// it. Fig. 7.
/// @param voxels  the voxels to use.
Cylinder FitCylinder(const VoxelCloud& cloud, std::span<const int> voxels, const Cylinder& start);

/// Grows a small cylinder in all dimensions until it would include empty voxels, and fits it again
/// after each step. Fig. 10 (b)–(d).
///
/// Dimensions grow by a voxel in turn. The paper does not say how much void stops growth.
/// @param voxels       those that turn the template; only cells without any voxel are void.
/// @param least_share  a step is made if at least this share of the added cells has voxels.
/// @param longest_mm   limit for the length.
Cylinder GrowCylinder(const VoxelCloud& cloud, std::span<const int> voxels, const Cylinder& start,
                      double least_share, double longest_mm);

}  // namespace mocap::mikic2003

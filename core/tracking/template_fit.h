// §6.2, §7.1: the two templates that find body parts by shape alone: a spherical crust for the
// head, a cylinder anchored at a joint for torso, upper arms and thighs.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/body/body_sizes.h"
#include "core/geometry.h"
#include "core/tracking/voxel_cloud.h"

namespace mocap {

/// The smallest and largest radius of the head that is looked for.
struct HeadCrust {
  double inner_mm;
  double outer_mm;
};

/// The crust of a body's head.
HeadCrust CrustOf(const BodySizes& sizes);

/// Where a head's centre may lie; anywhere unless it is said.
struct HeadRegion {
  Vector3 center_W = Vector3::Zero();
  double radius_mm = std::numeric_limits<double>::infinity();
  double lowest_mm = -std::numeric_limits<double>::infinity();

  bool Contains(const Vector3& p_WQ) const {
    return p_WQ.z() >= lowest_mm && (p_WQ - center_W).norm() <= radius_mm;
  }
};

struct HeadFit {
  Vector3 center_W;  ///< Centroid of the head's voxels.
  Vector3 neck_W;    ///< Middle of the border between head and body.
  double score = 0;  ///< Surface voxels in the crust less flesh around it, as a share of the crust.
  std::vector<int> voxels;  ///< Indices of the head's voxels.
};

/// Finds the centre of the crust that holds the most surface voxels and the least flesh beyond it.
/// Fig. 6.
std::optional<HeadFit> FindHead(const VoxelCloud& cloud, const HeadCrust& crust,
                                const HeadRegion& region);

/// A cylinder with an elliptic section that hangs from its anchor.
struct Cylinder {
  Vector3 anchor_W;
  Vector3 axis_W;  ///< Unit vector, away from the anchor.
  Vector3 side_W;  ///< Unit vector along which the section is `radius_mm` wide, square to the axis.
  double length_mm;
  double radius_mm;
  double depth_mm;  ///< Half the section's extent across the side.

  bool Contains(const Vector3& p_WQ) const;
};

/// A cylinder with a circular section.
Cylinder RoundCylinder(const Vector3& anchor_W, const Vector3& axis_W, double length_mm,
                       double radius_mm);

/// Turns the cylinder about its anchor until its axis passes through the centroid of the voxels
/// inside. Fig. 7.
/// @param voxels  indices of the voxels that count.
Cylinder FitCylinder(const VoxelCloud& cloud, std::span<const int> voxels, const Cylinder& start);

/// Grows a small cylinder about its anchor in all dimensions, turning it at every step, until it
/// would take in empty voxels. Fig. 10.
/// @param most  the largest size that is believable.
Cylinder GrowCylinder(const VoxelCloud& cloud, std::span<const int> voxels, const Cylinder& start,
                      const Cylinder& most);

/// Mean position of voxels; zero of none.
Vector3 CentroidOf(const VoxelCloud& cloud, std::span<const int> voxels);

}  // namespace mocap

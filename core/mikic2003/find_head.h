// §6.2, Fig. 6: the head, by its shape.
#pragma once

#include <optional>

#include "core/body/body_sizes.h"
#include "core/geometry.h"
#include "core/mikic2003/labels.h"
#include "core/reconstruction/carving/voxel_cloud.h"

namespace mocap::mikic2003 {

/// Two spheres around a head's centre, and a third that contains all of the head; radii [mm].
struct HeadCrust {
  double inner_mm;
  double outer_mm;
  double reach_mm;
};

/// Returns the crust of a head of known dimensions. It lies between the head's breadth and length,
/// which are 13 % below and above their mean, BodySizes::head_width (ANSUR, Gordon et al. 1989),
/// and is half a voxel wider on both sides.
HeadCrust CrustOf(const BodySizes& sizes, double voxel_mm);

/// The crust of any head, for the first frame (§7.1): from the breadth of a child's head, 140 mm
/// (Snyder et al. 1977), to the length of a tall man's, 210 mm; from chin to vertex his head
/// measures 250 mm (ANSUR, Gordon et al. 1989).
inline constexpr HeadCrust kAnyHead{.inner_mm = 70, .outer_mm = 105, .reach_mm = 150};

/// Region for the crust's centre, around the head's prediction.
struct SearchRegion {
  Vector3 center_W;
  double radius_mm;
};

/// A head that was found.
struct HeadFit {
  Vector3 center_W;     ///< Centroid of the head's voxels [mm].
  Vector3 neck_W;       ///< Mean of the head's voxels that border on the rest of the body [mm].
  VoxelIndices voxels;  ///< "In the sphere of a larger diameter" (Fig. 6 (c)).
};

/// Finds the centre whose crust contains the most surface voxels, and the head's voxels around it.
/// Fig. 6 (a)–(d).
///
/// The paper does not say which positions are tried. Here they are the voxels inside the body; of
/// two equally good ones, the upper wins. Of voxels finer than 25 mm (the paper's) only a part is
/// tried. A child's waist fills the crust as well as the head does. So the uppermost place whose
/// crust holds three quarters of the most shows where the head is, and the best place down to an
/// inner radius below it wins. Pieces outside the sphere that are connected with the head alone,
/// and are smaller, are hair, not neck.
/// @param region  nothing: the whole volume is searched.
/// @return  nothing if no voxel lies inside the body there.
std::optional<HeadFit> FindHead(const VoxelCloud& cloud, const HeadCrust& crust,
                                const std::optional<SearchRegion>& region);

}  // namespace mocap::mikic2003

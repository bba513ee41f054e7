// §7.2: widths of the parts, "very accurately determined from the data".
#pragma once

#include "core/body/body_sizes.h"
#include "core/mikic2003/labels.h"
#include "core/reconstruction/carving/voxel_cloud.h"

namespace mocap::mikic2003 {

/// Measures the widths of arms and legs from labelled voxels.
///
/// A width is that of a solid cylinder with the same two smaller principal moments. These are
/// averaged (§5.2), and so are left and right.
/// @param sizes  gets the widths of all parts that have enough voxels.
void MeasureLimbWidths(const VoxelCloud& cloud, const Labels& labels, BodySizes& sizes);

}  // namespace mocap::mikic2003

// §6.2: assignment of voxels to body parts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/body/body_part.h"
#include "core/geometry.h"
#include "core/reconstruction/carving/voxel_cloud.h"

namespace mocap::mikic2003 {

inline constexpr std::int8_t kUnlabeled = -1;

/// One label per voxel of the cloud: a BodyPart, or kUnlabeled.
using Labels = std::vector<std::int8_t>;

/// Indices of voxels of a cloud.
using VoxelIndices = std::vector<int>;

inline std::int8_t LabelOf(BodyPart part) { return static_cast<std::int8_t>(part); }

/// Returns the voxels with a label.
VoxelIndices VoxelsLabeled(const Labels& labels, std::int8_t label);

/// Sets the label of voxels.
void SetLabel(std::span<const int> voxels, std::int8_t label, Labels& labels);

/// Returns the mean position of voxels; zero if there are none.
Vector3 CentroidOf(const VoxelCloud& cloud, std::span<const int> voxels);

/// Returns the covariance of voxels' positions [mm²]; zero if there are none.
Matrix3 CovarianceOf(const VoxelCloud& cloud, std::span<const int> voxels);

/// Returns those voxels that have a direct neighbour (of six) labelled `neighbour`.
VoxelIndices BorderWith(const VoxelCloud& cloud, const Labels& labels, std::span<const int> voxels,
                        std::int8_t neighbour);

/// Splits voxels into connected regions (26 neighbours), the largest first.
std::vector<VoxelIndices> ConnectedRegions(const VoxelCloud& cloud, std::span<const int> voxels);

/// Finds the connected region with the voxel nearest to a point; empty if there are no voxels.
VoxelIndices PieceNearest(const VoxelCloud& cloud, std::span<const int> voxels, const Vector3& p_W);

}  // namespace mocap::mikic2003

#include "core/mikic2003/labels.h"

#include <algorithm>

namespace mocap::mikic2003 {
namespace {

constexpr std::array<std::array<int, 3>, 6> kFaces = {
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

// Takes all voxels that are connected with the first one out of `waiting`.
VoxelIndices TakeRegion(const VoxelCloud& cloud, int first, std::vector<char>& waiting) {
  VoxelIndices region = {first};
  waiting[first] = false;
  for (std::size_t next = 0; next < region.size(); ++next) {
    const Eigen::Vector3i cell = cloud.voxels()[region[next]].cell;
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int neighbour = cloud.IndexAt(Eigen::Vector3i(cell + Eigen::Vector3i(dx, dy, dz)));
          if (neighbour < 0 || !waiting[neighbour]) continue;
          waiting[neighbour] = false;
          region.push_back(neighbour);
        }
      }
    }
  }
  return region;
}

}  // namespace

VoxelIndices VoxelsLabeled(const Labels& labels, std::int8_t label) {
  VoxelIndices voxels;
  for (int i = 0; i < static_cast<int>(labels.size()); ++i) {
    if (labels[i] == label) voxels.push_back(i);
  }
  return voxels;
}

void SetLabel(std::span<const int> voxels, std::int8_t label, Labels& labels) {
  for (const int voxel : voxels) labels[voxel] = label;
}

Vector3 CentroidOf(const VoxelCloud& cloud, std::span<const int> voxels) {
  Vector3 sum = Vector3::Zero();
  for (const int voxel : voxels) sum += cloud.voxels()[voxel].center_W;
  return voxels.empty() ? sum : Vector3(sum / static_cast<double>(voxels.size()));
}

Matrix3 CovarianceOf(const VoxelCloud& cloud, std::span<const int> voxels) {
  const Vector3 mean_W = CentroidOf(cloud, voxels);
  Matrix3 covariance = Matrix3::Zero();
  for (const int voxel : voxels) {
    const Vector3 offset = cloud.voxels()[voxel].center_W - mean_W;
    covariance += offset * offset.transpose();
  }
  return covariance / std::max<double>(1, static_cast<double>(voxels.size()));
}

VoxelIndices BorderWith(const VoxelCloud& cloud, const Labels& labels, std::span<const int> voxels,
                        std::int8_t neighbour) {
  VoxelIndices border;
  for (const int voxel : voxels) {
    const Eigen::Vector3i cell = cloud.voxels()[voxel].cell;
    const bool touches = std::ranges::any_of(kFaces, [&](const std::array<int, 3>& step) {
      const int beside =
          cloud.IndexAt(Eigen::Vector3i(cell + Eigen::Vector3i(step[0], step[1], step[2])));
      return beside >= 0 && labels[beside] == neighbour;
    });
    if (touches) border.push_back(voxel);
  }
  return border;
}

std::vector<VoxelIndices> ConnectedRegions(const VoxelCloud& cloud, std::span<const int> voxels) {
  std::vector<char> waiting(cloud.size(), false);
  for (const int voxel : voxels) waiting[voxel] = true;
  std::vector<VoxelIndices> regions;
  for (const int voxel : voxels) {
    if (waiting[voxel]) regions.push_back(TakeRegion(cloud, voxel, waiting));
  }
  std::ranges::stable_sort(regions, std::ranges::greater(), &VoxelIndices::size);
  return regions;
}

VoxelIndices PieceNearest(const VoxelCloud& cloud, std::span<const int> voxels,
                          const Vector3& p_W) {
  if (voxels.empty()) return {};
  const int nearest = *std::ranges::min_element(
      voxels, {}, [&](int voxel) { return (cloud.voxels()[voxel].center_W - p_W).norm(); });
  std::vector<char> waiting(cloud.size(), false);
  for (const int voxel : voxels) waiting[voxel] = true;
  VoxelIndices piece = TakeRegion(cloud, nearest, waiting);
  std::ranges::sort(piece);
  return piece;
}

}  // namespace mocap::mikic2003

#include "core/mikic2003/measured_points.h"

#include <algorithm>
#include <cmath>

namespace mocap::mikic2003 {
namespace {

constexpr double kFewestLitres = 0.1;
constexpr std::size_t kEndShare = 20;

using PartVoxels = std::array<VoxelIndices, kBodyPartCount>;

bool IsEnough(const VoxelCloud& cloud, const VoxelIndices& voxels) {
  return static_cast<double>(voxels.size()) * std::pow(cloud.voxel_mm(), 3) * 1e-6 >= kFewestLitres;
}

// Mean of the twentieth of the voxels with the largest values of `measure`.
template <typename Measure>
Vector3 FarthestBy(const VoxelCloud& cloud, VoxelIndices voxels, const Measure& measure) {
  const auto count = static_cast<std::ptrdiff_t>((voxels.size() + kEndShare - 1) / kEndShare);
  std::ranges::partial_sort(voxels, voxels.begin() + count, [&](int a, int b) {
    const double of_a = measure(cloud.voxels()[a].center_W);
    const double of_b = measure(cloud.voxels()[b].center_W);
    return of_a != of_b ? of_a > of_b : a < b;
  });
  voxels.resize(count);
  return CentroidOf(cloud, voxels);
}

Vector3 EndAlong(const VoxelCloud& cloud, const VoxelIndices& voxels, const Vector3& direction_W) {
  return FarthestBy(cloud, voxels, [&](const Vector3& p_W) { return direction_W.dot(p_W); });
}

Vector3 EndFrom(const VoxelCloud& cloud, const VoxelIndices& voxels, const Vector3& from_W) {
  return FarthestBy(cloud, voxels, [&](const Vector3& p_W) { return (p_W - from_W).norm(); });
}

void MeasureLimb(const VoxelCloud& cloud, const PartVoxels& voxels, const Limb& parts,
                 const Vector3& axis_W, MeasuredPoints& points) {
  const VoxelIndices& upper = voxels[static_cast<int>(parts.upper)];
  const VoxelIndices& lower = voxels[static_cast<int>(parts.lower)];
  if (!IsEnough(cloud, upper)) return;
  const Vector3 joint_W = EndAlong(cloud, upper, axis_W);
  At(points, parts.root) = EndAlong(cloud, upper, -axis_W);
  At(points, parts.joint) = joint_W;
  if (IsEnough(cloud, lower)) At(points, parts.end) = EndFrom(cloud, lower, joint_W);
}

}  // namespace

MeasuredPoints MeasurePoints(const VoxelCloud& cloud, const LabeledFrame& frame) {
  PartVoxels voxels;
  MeasuredPoints points;
  for (int part = 0; part < kBodyPartCount; ++part) {
    voxels[part] = VoxelsLabeled(frame.labels, static_cast<std::int8_t>(part));
    // The first ten points are the parts' centroids.
    if (IsEnough(cloud, voxels[part])) points[part] = CentroidOf(cloud, voxels[part]);
  }
  if (At(points, Point::kHead)) At(points, Point::kNeck) = frame.neck_W;
  for (int limb = 0; limb < kLimbCount; ++limb) {
    MeasureLimb(cloud, voxels, kLimbs[limb], frame.upper_axes_W[limb], points);
  }
  return points;
}

}  // namespace mocap::mikic2003

#include "core/mikic2003/cylinder.h"

#include <algorithm>
#include <cmath>

namespace mocap::mikic2003 {
namespace {

constexpr int kMostTurns = 20;
constexpr double kStillRad = 0.005;

Eigen::AlignedBox3d BoxOf(const Cylinder& cylinder) {
  const double reach_mm = std::max(cylinder.half_width_mm, cylinder.half_depth_mm);
  Eigen::AlignedBox3d box_W(cylinder.anchor_W);
  box_W.extend(cylinder.End());
  return {box_W.min().array() - reach_mm, box_W.max().array() + reach_mm};
}

// Share of occupied cells among those in the larger but not the smaller cylinder; 0 of none.
double FullShareBetween(const VoxelCloud& cloud, const Cylinder& smaller, const Cylinder& larger) {
  const Vector3 origin_W = cloud.box_W().min();
  const double voxel_mm = cloud.voxel_mm();
  const auto cell_of = [&](const Vector3& p_W) {
    return Eigen::Vector3i(((p_W - origin_W) / voxel_mm).array().floor().cast<int>());
  };
  const Eigen::AlignedBox3d box_W = BoxOf(larger);
  const Eigen::Vector3i first = cell_of(box_W.min()), last = cell_of(box_W.max());
  int cells = 0, full = 0;
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) {
        const Eigen::Vector3i cell(x, y, z);
        const Vector3 center_W = origin_W + voxel_mm * (cell.cast<double>().array() + 0.5).matrix();
        if (!larger.Contains(center_W) || smaller.Contains(center_W)) continue;
        ++cells;
        full += cloud.IndexAt(cell) >= 0;
      }
    }
  }
  return cells > 0 ? static_cast<double>(full) / cells : 0;
}

}  // namespace

bool Cylinder::Contains(const Vector3& p_WQ) const {
  const Vector3 offset = p_WQ - anchor_W;
  const double along = offset.dot(axis_W);
  if (along < 0 || along > length_mm) return false;
  const double side = offset.dot(side_W) / half_width_mm;
  const double front = offset.dot(axis_W.cross(side_W)) / half_depth_mm;
  return side * side + front * front <= 1;
}

void Cylinder::TurnTo(const Vector3& axis) {
  side_W = RotationBetween(axis_W, axis) * side_W;
  axis_W = axis;
}

Cylinder RoundCylinder(const Vector3& anchor_W, const Vector3& axis_W, double length_mm,
                       double radius_mm) {
  return {anchor_W, axis_W, axis_W.unitOrthogonal(), length_mm, radius_mm, radius_mm};
}

Cylinder RoundWithRim(const Cylinder& torso, double rim_mm) {
  Cylinder round = torso;
  round.half_width_mm = std::max(torso.half_width_mm, torso.half_depth_mm) + rim_mm;
  round.half_depth_mm = round.half_width_mm;
  return round;
}

VoxelIndices VoxelsInside(const VoxelCloud& cloud, std::span<const int> voxels,
                          const Cylinder& cylinder) {
  VoxelIndices inside;
  for (const int voxel : voxels) {
    if (cylinder.Contains(cloud.voxels()[voxel].center_W)) inside.push_back(voxel);
  }
  return inside;
}

Cylinder FitCylinder(const VoxelCloud& cloud, std::span<const int> voxels, const Cylinder& start) {
  Cylinder cylinder = start;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const VoxelIndices inside = VoxelsInside(cloud, voxels, cylinder);
    const Vector3 to_centroid_W = CentroidOf(cloud, inside) - cylinder.anchor_W;
    if (inside.empty() || to_centroid_W.norm() < 1) break;
    const Vector3 axis_W = to_centroid_W.normalized();
    const double turned_rad = std::acos(std::clamp(axis_W.dot(cylinder.axis_W), -1.0, 1.0));
    cylinder.TurnTo(axis_W);
    if (turned_rad < kStillRad) break;
  }
  return cylinder;
}

Cylinder GrowCylinder(const VoxelCloud& cloud, std::span<const int> voxels, const Cylinder& start,
                      double least_share, double longest_mm) {
  const double voxel_mm = cloud.voxel_mm();
  Cylinder cylinder = start;
  const auto grow = [&](double Cylinder::*dimension, double step_mm) {
    Cylinder grown = cylinder;
    grown.*dimension += step_mm;
    if (grown.length_mm > longest_mm) return false;
    if (FullShareBetween(cloud, cylinder, grown) < least_share) return false;
    cylinder = FitCylinder(cloud, voxels, grown);
    return true;
  };
  // A dimension that met void may grow on once the others have.
  for (bool grows = true; grows;) {
    grows = grow(&Cylinder::half_width_mm, voxel_mm / 2);
    grows = grow(&Cylinder::half_depth_mm, voxel_mm / 2) || grows;
    grows = grow(&Cylinder::length_mm, voxel_mm) || grows;
  }
  return cylinder;
}

}  // namespace mocap::mikic2003

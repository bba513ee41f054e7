#include "core/tracking/template_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/tracking/head_score.h"

namespace mocap {
namespace {

constexpr int kMostTurns = 12;
constexpr double kStillDegrees = 0.5;
Vector3 BorderOf(const VoxelCloud& cloud, const Vector3& center_W, double radius_mm,
                 std::span<const int> inside) {
  Vector3 sum = Vector3::Zero();
  int count = 0;
  for (const int index : inside) {
    const Voxel& voxel = cloud.voxels()[index];
    for (int axis = 0; axis < 6; ++axis) {
      Eigen::Vector3i step = Eigen::Vector3i::Zero();
      step[axis / 2] = axis % 2 == 0 ? 1 : -1;
      const int neighbour = cloud.IndexAt(Eigen::Vector3i(voxel.cell + step));
      if (neighbour < 0) continue;
      if ((cloud.voxels()[neighbour].center_W - center_W).norm() <= radius_mm) continue;
      sum += voxel.center_W;
      ++count;
      break;
    }
  }
  return count > 0 ? Vector3(sum / count) : Vector3(center_W - radius_mm * Vector3::UnitZ());
}

// Share of the places in a cylinder between two distances from its anchor that hold flesh: on its
// axis and on the outer part of its section.
double FleshShare(const VoxelCloud& cloud, const Cylinder& cylinder, double from_mm, double to_mm) {
  constexpr int kTurns = 12;
  const Vector3 front_W = cylinder.axis_W.cross(cylinder.side_W);
  int places = 0;
  int flesh = 0;
  for (double along = from_mm; along < to_mm; along += cloud.voxel_mm()) {
    const Vector3 center_W = cylinder.anchor_W + along * cylinder.axis_W;
    for (int turn = 0; turn < kTurns; ++turn) {
      const double angle = turn * 2 * EIGEN_PI / kTurns;
      const Vector3 p_W =
          center_W + 0.85 * (cylinder.radius_mm * std::cos(angle) * cylinder.side_W +
                             cylinder.depth_mm * std::sin(angle) * front_W);
      places += 2;
      flesh += cloud.IndexAt(p_W) >= 0;
      flesh += cloud.IndexAt(Vector3((p_W + center_W) / 2)) >= 0;
    }
  }
  return places > 0 ? static_cast<double>(flesh) / places : 0;
}

}  // namespace

Vector3 CentroidOf(const VoxelCloud& cloud, std::span<const int> voxels) {
  Vector3 sum = Vector3::Zero();
  for (const int index : voxels) sum += cloud.voxels()[index].center_W;
  return voxels.empty() ? sum : Vector3(sum / static_cast<double>(voxels.size()));
}

HeadCrust CrustOf(const BodySizes& sizes) {
  return {.inner_mm = 0.35 * sizes.head_width, .outer_mm = 0.54 * sizes.head};
}

std::optional<HeadFit> FindHead(const VoxelCloud& cloud, const HeadCrust& crust,
                                const HeadRegion& region) {
  const HeadScore head_score(cloud, crust);
  HeadFit best;
  best.score = -std::numeric_limits<double>::infinity();
  int best_index = -1;
  // From above, where heads are.
  for (int i = cloud.size() - 1; i >= 0; --i) {
    const Voxel& voxel = cloud.voxels()[i];
    // A head's centre lies deep inside.
    if (voxel.surface || !head_score.IsOnLattice(voxel.cell)) continue;
    if (!region.Contains(voxel.center_W)) continue;
    if (const auto score = head_score.Above(best.score, voxel.cell)) {
      best.score = *score;
      best_index = i;
    }
  }
  if (best_index < 0) return std::nullopt;

  const Vector3 center_W = cloud.voxels()[best_index].center_W;
  for (int i = 0; i < cloud.size(); ++i) {
    if ((cloud.voxels()[i].center_W - center_W).norm() <= crust.outer_mm) best.voxels.push_back(i);
  }
  best.center_W = CentroidOf(cloud, best.voxels);
  best.neck_W = BorderOf(cloud, center_W, crust.outer_mm, best.voxels);
  return best;
}

bool Cylinder::Contains(const Vector3& p_WQ) const {
  const Vector3 offset = p_WQ - anchor_W;
  const double along = offset.dot(axis_W);
  if (along < 0 || along > length_mm) return false;
  const double side = offset.dot(side_W);
  const double front_sq = offset.squaredNorm() - along * along - side * side;
  return side * side / (radius_mm * radius_mm) + front_sq / (depth_mm * depth_mm) <= 1;
}

Cylinder RoundCylinder(const Vector3& anchor_W, const Vector3& axis_W, double length_mm,
                       double radius_mm) {
  return {anchor_W, axis_W, axis_W.unitOrthogonal(), length_mm, radius_mm, radius_mm};
}

Cylinder FitCylinder(const VoxelCloud& cloud, std::span<const int> voxels, const Cylinder& start) {
  Cylinder cylinder = start;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    Vector3 sum = Vector3::Zero();
    int count = 0;
    for (const int index : voxels) {
      const Vector3& p_W = cloud.voxels()[index].center_W;
      if (!cylinder.Contains(p_W)) continue;
      sum += p_W;
      ++count;
    }
    if (count == 0) break;
    const Vector3 axis_W = (sum / count - cylinder.anchor_W).normalized();
    const double turned = std::acos(std::clamp(axis_W.dot(cylinder.axis_W), -1.0, 1.0));
    cylinder.axis_W = axis_W;
    cylinder.side_W = (cylinder.side_W - cylinder.side_W.dot(axis_W) * axis_W).normalized();
    if (turned < kStillDegrees * EIGEN_PI / 180) break;
  }
  return cylinder;
}

Cylinder GrowCylinder(const VoxelCloud& cloud, std::span<const int> voxels, const Cylinder& start,
                      const Cylinder& most) {
  constexpr double kFull = 0.9;
  const double step_mm = cloud.voxel_mm();
  Cylinder cylinder = start;
  // Each dimension grows until it meets the void or its largest size; the others go on.
  const auto grow = [&](double Cylinder::*dimension) {
    if (cylinder.*dimension + step_mm / 2 > most.*dimension) return false;
    Cylinder grown = cylinder;
    grown.*dimension += step_mm / 2;
    grown = FitCylinder(cloud, voxels, grown);
    const bool longer = dimension == &Cylinder::length_mm;
    // The neck, where the cylinder hangs, is thinner than what hangs below it.
    const double from_mm = longer ? grown.length_mm - step_mm : 0.35 * grown.length_mm;
    if (FleshShare(cloud, grown, from_mm, grown.length_mm) < kFull) return false;
    cylinder = grown;
    return true;
  };
  bool longer = true, wider = true, deeper = true;
  while (longer || wider || deeper) {
    longer = longer && grow(&Cylinder::length_mm);
    wider = wider && grow(&Cylinder::radius_mm);
    deeper = deeper && grow(&Cylinder::depth_mm);
  }
  return cylinder;
}

}  // namespace mocap

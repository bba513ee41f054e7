#include "core/acquisition/body_localizer.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

// An average torso as shares of the person's height, and the sizes that growing starts from and
// ends at.
constexpr double kTorsoLength = 0.33;
constexpr double kTorsoRadius = 0.09;
constexpr double kSmallTorso = 0.4;
constexpr double kLargestTorso = 1.4;
constexpr double kSmallestLimbLitres = 0.3;
// How round a head is at least, as a share of what else is round.
constexpr double kNearlyAsRound = 0.6;

// The direction square to the axis in which the voxels in a cylinder spread most: from side to
// side.
Vector3 WidestSide(const VoxelCloud& cloud, const std::vector<int>& voxels,
                   const Cylinder& cylinder) {
  Matrix3 spread = Matrix3::Zero();
  for (const int index : voxels) {
    const Vector3& p_W = cloud.voxels()[index].center_W;
    if (!cylinder.Contains(p_W)) continue;
    Vector3 offset = p_W - cylinder.anchor_W;
    offset -= offset.dot(cylinder.axis_W) * cylinder.axis_W;
    spread += offset * offset.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(spread);
  const Vector3 side_W = solver.eigenvectors().col(2);
  return (side_W - side_W.dot(cylinder.axis_W) * cylinder.axis_W).normalized();
}

Cylinder FitTorso(const VoxelCloud& cloud, const std::vector<int>& body, const HeadFit& head,
                  double height_mm) {
  const Vector3 down_W = (CentroidOf(cloud, body) - head.neck_W).normalized();
  const Cylinder average = FitCylinder(
      cloud, body,
      RoundCylinder(head.neck_W, down_W, kTorsoLength * height_mm, kTorsoRadius * height_mm));
  Cylinder small = average;
  small.side_W = WidestSide(cloud, body, average);
  small.length_mm *= kSmallTorso;
  small.radius_mm *= kSmallTorso;
  small.depth_mm *= kSmallTorso;
  Cylinder most = average;
  most.length_mm *= kLargestTorso;
  most.radius_mm *= kLargestTorso;
  most.depth_mm *= kLargestTorso;
  return GrowCylinder(cloud, body, small, most);
}

// Connected regions among the voxels that are marked free, the largest first.
std::vector<std::vector<int>> Regions(const VoxelCloud& cloud, std::vector<bool>& free) {
  std::vector<std::vector<int>> regions;
  for (int seed = 0; seed < cloud.size(); ++seed) {
    if (!free[seed]) continue;
    free[seed] = false;
    std::vector<int> region = {seed};
    for (std::size_t i = 0; i < region.size(); ++i) {
      const Eigen::Vector3i cell = cloud.voxels()[region[i]].cell;
      for (int axis = 0; axis < 6; ++axis) {
        Eigen::Vector3i step = Eigen::Vector3i::Zero();
        step[axis / 2] = axis % 2 == 0 ? 1 : -1;
        const int neighbour = cloud.IndexAt(Eigen::Vector3i(cell + step));
        if (neighbour < 0 || !free[neighbour]) continue;
        free[neighbour] = false;
        region.push_back(neighbour);
      }
    }
    regions.push_back(std::move(region));
  }
  std::sort(regions.begin(), regions.end(),
            [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return regions;
}

Vector3 RootOf(const VoxelCloud& cloud, const std::vector<int>& region,
               const std::vector<bool>& in_torso, const Cylinder& torso) {
  Vector3 sum = Vector3::Zero();
  int count = 0;
  for (const int index : region) {
    for (int axis = 0; axis < 6; ++axis) {
      Eigen::Vector3i step = Eigen::Vector3i::Zero();
      step[axis / 2] = axis % 2 == 0 ? 1 : -1;
      const int neighbour = cloud.IndexAt(Eigen::Vector3i(cloud.voxels()[index].cell + step));
      if (neighbour < 0 || !in_torso[neighbour]) continue;
      sum += cloud.voxels()[index].center_W;
      ++count;
      break;
    }
  }
  if (count > 0) return sum / count;
  // Torn off the torso: its place nearest to the torso's middle.
  const Vector3 middle_W = torso.anchor_W + 0.5 * torso.length_mm * torso.axis_W;
  const int nearest = *std::min_element(region.begin(), region.end(), [&](int a, int b) {
    return (cloud.voxels()[a].center_W - middle_W).squaredNorm() <
           (cloud.voxels()[b].center_W - middle_W).squaredNorm();
  });
  return cloud.voxels()[nearest].center_W;
}

LimbBlob LimbOf(const VoxelCloud& cloud, std::vector<int> region, const std::vector<bool>& in_torso,
                const Cylinder& torso, double height_mm) {
  LimbBlob limb;
  limb.root_W = RootOf(cloud, region, in_torso, torso);
  const Vector3 along_W = (CentroidOf(cloud, region) - limb.root_W).normalized();
  const Cylinder small = RoundCylinder(limb.root_W, along_W, 0.08 * height_mm, cloud.voxel_mm());
  const Cylinder most = RoundCylinder(limb.root_W, along_W, 0.25 * height_mm, 0.06 * height_mm);
  const Cylinder upper = GrowCylinder(cloud, region, small, most);
  limb.joint_W = upper.anchor_W + upper.length_mm * upper.axis_W;
  // The tip is what lies farthest beyond the joint; of a limb that does not bend, farthest from its
  // root.
  const int tip = *std::max_element(region.begin(), region.end(), [&](int a, int b) {
    const auto reach = [&](int index) {
      const Vector3& p_W = cloud.voxels()[index].center_W;
      return (p_W - limb.joint_W).norm() + 0.5 * (p_W - limb.root_W).norm();
    };
    return reach(a) < reach(b);
  });
  limb.tip_W = cloud.voxels()[tip].center_W;
  limb.voxels = std::move(region);
  return limb;
}

// Nobody is acquired upside down, yet a heel may be nearly as round as a head.
std::optional<HeadFit> FindUprightHead(const VoxelCloud& cloud, const HeadCrust& crust) {
  const std::optional<HeadFit> anywhere = FindHead(cloud, crust, {});
  const double middle_mm = cloud.Centroid().z();
  if (!anywhere || anywhere->center_W.z() > middle_mm) return anywhere;
  const std::optional<HeadFit> above = FindHead(cloud, crust, {.lowest_mm = middle_mm});
  if (!above || above->score < kNearlyAsRound * anywhere->score) return std::nullopt;
  return above;
}

}  // namespace

std::optional<LocalizedBody> LocalizeBody(const VoxelCloud& cloud, const HeadCrust& crust) {
  const std::optional<HeadFit> head = FindUprightHead(cloud, crust);
  if (!head) return std::nullopt;
  LocalizedBody body;
  body.head = *head;
  // Hands may be higher than the head, and a block or a leap carries the feet.
  const double half_mm = cloud.voxel_mm() / 2;
  double top_mm = 0, bottom_mm = head->center_W.z();
  for (const int index : head->voxels) {
    top_mm = std::max(top_mm, cloud.voxels()[index].center_W.z() + half_mm);
  }
  for (const Voxel& voxel : cloud.voxels()) {
    bottom_mm = std::min(bottom_mm, voxel.center_W.z() - half_mm);
  }
  body.height_mm = top_mm - std::max(0.0, bottom_mm);

  std::vector<bool> free(cloud.size(), true);
  for (const int index : head->voxels) free[index] = false;
  std::vector<int> rest;
  for (int i = 0; i < cloud.size(); ++i) {
    if (free[i]) rest.push_back(i);
  }
  if (rest.empty()) return std::nullopt;
  body.torso = FitTorso(cloud, rest, *head, body.height_mm);

  std::vector<bool> in_torso(cloud.size(), false);
  for (const int index : rest)
    in_torso[index] = body.torso.Contains(cloud.voxels()[index].center_W);
  for (const int index : rest) free[index] = !in_torso[index];
  const double voxel_litres = std::pow(cloud.voxel_mm(), 3) * 1e-6;
  for (std::vector<int>& region : Regions(cloud, free)) {
    if (body.limbs.size() == 4 || region.size() * voxel_litres < kSmallestLimbLitres) break;
    body.limbs.push_back(LimbOf(cloud, std::move(region), in_torso, body.torso, body.height_mm));
  }
  return body;
}

}  // namespace mocap

#include "core/mikic2003/locate_body.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mikic2003/find_head.h"
#include "core/mikic2003/size_network.h"

namespace mocap::mikic2003 {
namespace {

constexpr double kAverageStatureMm = 1700;
// Small templates to be grown.
constexpr double kSmallTorsoMm = 150, kSmallTorsoRadiusMm = 60;
constexpr double kSmallLimbMm = 60, kSmallLimbRadiusMm = 30;
// A template has the size of its part if half of the next step would be void.
constexpr double kSizeShare = 0.5;
// The template for the torso's voxels grows while a quarter of a step is flesh. Otherwise the
// trunk's rim connects the limbs, and there are not four regions (Fig. 11 (f)).
constexpr double kRimShare = 0.25;
constexpr double kAnyLength = std::numeric_limits<double>::infinity();
// A smaller share of the body is a stray piece of the torso and no limb. An arm has 0.05 of a
// body's mass (Winter 2009, Table 4.1), but a part of it may be in the torso's template.
constexpr double kLeastLimbShare = 0.025;

const BodySizes kAverage = AverageSizes(kAverageStatureMm);

Matrix3 CovarianceOf(const VoxelCloud& cloud, std::span<const int> voxels) {
  const Vector3 mean_W = CentroidOf(cloud, voxels);
  Matrix3 covariance = Matrix3::Zero();
  for (const int voxel : voxels) {
    const Vector3 offset = cloud.voxels()[voxel].center_W - mean_W;
    covariance += offset * offset.transpose();
  }
  return covariance / std::max<double>(1, static_cast<double>(voxels.size()));
}

// Distance between the lowest and the highest position along a direction.
double ExtentOf(const VoxelCloud& cloud, std::span<const int> voxels, const Vector3& direction_W) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const int voxel : voxels) {
    const double along = direction_W.dot(cloud.voxels()[voxel].center_W);
    least = std::min(least, along);
    most = std::max(most, along);
  }
  return most - least + cloud.voxel_mm();
}

double HeightOf(const VoxelCloud& cloud) {
  VoxelIndices all(cloud.size());
  for (int i = 0; i < cloud.size(); ++i) all[i] = i;
  return ExtentOf(cloud, all, Vector3::UnitZ());
}

// The head's length is its extent along the neck. Its width is that of a ball with the second
// moments of the head's middle: the two smaller dimensions are averaged (§5.2).
void MeasureHead(const VoxelCloud& cloud, const HeadFit& head, BodySizes& sizes) {
  const Vector3 up_W = (head.center_W - head.neck_W).normalized();
  sizes.neck = (head.center_W - head.neck_W).norm();
  sizes.head = ExtentOf(cloud, head.voxels, up_W);
  VoxelIndices middle = head.voxels;
  std::erase_if(middle, [&](int voxel) {
    return (cloud.voxels()[voxel].center_W - head.center_W).norm() > kAnyHead.outer_mm;
  });
  const Eigen::SelfAdjointEigenSolver<Matrix3> axes(CovarianceOf(cloud, middle));
  const Vector3 dimensions_mm = 2 * std::sqrt(5.0) * axes.eigenvalues().cwiseMax(0).cwiseSqrt();
  sizes.head_width = (dimensions_mm[0] + dimensions_mm[1]) / 2;
}

void MeasureTorso(const Cylinder& torso, BodySizes& sizes) {
  sizes.torso = torso.length_mm;
  sizes.torso_width = 2 * std::max(torso.half_width_mm, torso.half_depth_mm);
  sizes.torso_depth = 2 * std::min(torso.half_width_mm, torso.half_depth_mm);
  // Fig. 3: joints lie at fixed shares of the torso's width, here those of average people.
  sizes.shoulder_width = sizes.torso_width * kAverage.shoulder_width / kAverage.torso_width;
  sizes.hip_width = sizes.torso_width * kAverage.hip_width / kAverage.torso_width;
}

// A limb's region and the joint where it meets the torso.
struct Region {
  VoxelIndices voxels;
  Vector3 root_W;
};
using Regions = std::array<Region, kLimbCount>;

// Fig. 11 (f): the four largest connected regions that remain.
std::optional<Regions> FindLimbs(const VoxelCloud& cloud, const Labels& labels) {
  const std::vector<VoxelIndices> connected =
      ConnectedRegions(cloud, VoxelsLabeled(labels, kUnlabeled));
  if (connected.size() < kLimbCount) return std::nullopt;
  Regions regions;
  for (int i = 0; i < kLimbCount; ++i) {
    if (static_cast<double>(connected[i].size()) < kLeastLimbShare * cloud.size()) {
      return std::nullopt;
    }
    const VoxelIndices border = BorderWith(cloud, labels, connected[i], LabelOf(BodyPart::kTorso));
    if (border.empty()) return std::nullopt;
    regions[i] = {connected[i], CentroidOf(cloud, border)};
  }
  return regions;
}

// Sorts arms before legs and one side before the other; returns the direction of that side.
Vector3 SortLimbs(const Cylinder& torso, Regions& regions) {
  const auto along = [&](const Region& region) {
    return torso.axis_W.dot(region.root_W - torso.anchor_W);
  };
  std::ranges::sort(regions, {}, along);
  Vector3 side_W = regions[0].root_W - regions[1].root_W;
  const Vector3 hips_W = regions[2].root_W - regions[3].root_W;
  side_W += hips_W.dot(side_W) < 0 ? Vector3(-hips_W) : hips_W;
  side_W = (side_W - side_W.dot(torso.axis_W) * torso.axis_W).normalized();
  for (const int first : {0, 2}) {
    if (side_W.dot(regions[first].root_W - regions[first + 1].root_W) < 0) {
      std::swap(regions[first], regions[first + 1]);
    }
  }
  return side_W;
}

double FarthestFrom(const VoxelCloud& cloud, const Region& region) {
  double farthest_mm = 0;
  for (const int voxel : region.voxels) {
    farthest_mm = std::max(farthest_mm, (cloud.voxels()[voxel].center_W - region.root_W).norm());
  }
  return farthest_mm;
}

// Fig. 11 (g): places the template of an average upper arm or thigh, then grows a small one there.
// The end of a straight limb's upper part is not visible: its length is at most its share by Table
// 3.
Cylinder GrowUpper(const VoxelCloud& cloud, const Region& region, const Limb& limb) {
  const double longest_mm = limb.upper_share * FarthestFrom(cloud, region);
  const Vector3 axis_W = (CentroidOf(cloud, region.voxels) - region.root_W).normalized();
  const Cylinder average =
      FitCylinder(cloud, region.voxels,
                  RoundCylinder(region.root_W, axis_W, kAverage.*limb.upper_length,
                                kAverage.*limb.upper_width / 2));
  return GrowCylinder(
      cloud, region.voxels,
      RoundCylinder(region.root_W, average.axis_W, kSmallLimbMm, kSmallLimbRadiusMm), kSizeShare,
      longest_mm);
}

// Fig. 11 (h): from the rest of a limb, takes the piece closest to the end of its upper part.
VoxelIndices FindLower(const VoxelCloud& cloud, const Labels& labels, const Region& region,
                       const Cylinder& upper) {
  VoxelIndices rest;
  for (const int voxel : region.voxels) {
    if (labels[voxel] == kUnlabeled) rest.push_back(voxel);
  }
  return PieceNearest(cloud, rest, upper.End());
}

double WidthOf(const Cylinder& grown) { return grown.half_width_mm + grown.half_depth_mm; }

// Fig. 11 (h): grows a template in the rest of the limb, starting where it meets the upper part.
Cylinder GrowLower(const VoxelCloud& cloud, const Labels& labels, const VoxelIndices& lower,
                   const Limb& limb) {
  const VoxelIndices meeting = BorderWith(cloud, labels, lower, LabelOf(limb.upper));
  const Vector3 joint_W = CentroidOf(cloud, meeting.empty() ? lower : meeting);
  const Vector3 to_centroid_W = CentroidOf(cloud, lower) - joint_W;
  const Vector3 axis_W =
      to_centroid_W.norm() < 1 ? Vector3::UnitZ() : Vector3(to_centroid_W.normalized());
  return GrowCylinder(cloud, lower,
                      RoundCylinder(joint_W, axis_W, kSmallLimbMm, kSmallLimbRadiusMm), kSizeShare,
                      kAnyLength);
}

void LabelLimb(const VoxelCloud& cloud, const Region& region, int limb, LocatedBody& located) {
  const Limb& parts = kLimbs[limb];
  const Cylinder upper = GrowUpper(cloud, region, parts);
  SetLabel(VoxelsInside(cloud, region.voxels, upper), LabelOf(parts.upper), located.frame.labels);
  const VoxelIndices lower = FindLower(cloud, located.frame.labels, region, upper);
  SetLabel(lower, LabelOf(parts.lower), located.frame.labels);
  located.frame.upper_axes_W[limb] = upper.axis_W;
  BodySizes& sizes = located.sizes;
  // Both sides have one size: the mean of their measurements.
  sizes.*parts.upper_length += upper.length_mm / 2;
  sizes.*parts.upper_width += WidthOf(upper) / 2;
  sizes.*parts.lower_width += WidthOf(GrowLower(cloud, located.frame.labels, lower, parts)) / 2;
}

// Parts that are too small to measure get their length from their proportion to the torso.
void MeasureLowerLengths(const VoxelCloud& cloud, LocatedBody& located) {
  const MeasuredPoints points = MeasurePoints(cloud, located.frame);
  const LengthMeasurements lengths = MeasureLengths(points, located.height_less_head_mm);
  BodySizes& sizes = located.sizes;
  sizes.lower_arm = lengths.lower_arm.value_or(kLowerArmPerTorso * sizes.torso);
  sizes.calf = lengths.calf.value_or(kCalfPerTorso * sizes.torso);
}

}  // namespace

Cylinder GrowTorso(const VoxelCloud& cloud, std::span<const int> voxels, const Vector3& neck_W) {
  const Vector3 down_W = (CentroidOf(cloud, voxels) - neck_W).normalized();
  const Cylinder average = FitCylinder(
      cloud, voxels, RoundCylinder(neck_W, down_W, kAverage.torso, kAverage.torso_width / 2));
  Cylinder small = RoundCylinder(neck_W, average.axis_W, kSmallTorsoMm, kSmallTorsoRadiusMm);
  const Matrix3 across = Matrix3::Identity() - average.axis_W * average.axis_W.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3> axes(
      across * CovarianceOf(cloud, VoxelsInside(cloud, voxels, average)) * across);
  small.side_W = axes.eigenvectors().col(2);
  return GrowCylinder(cloud, voxels, small, kSizeShare, kAnyLength);
}

std::optional<LocatedBody> LocateBody(const VoxelCloud& cloud) {
  const std::optional<HeadFit> head = FindHead(cloud, kAnyHead, std::nullopt);
  if (!head) return std::nullopt;
  LocatedBody located;
  Labels& labels = located.frame.labels;
  labels.assign(cloud.size(), kUnlabeled);
  SetLabel(head->voxels, LabelOf(BodyPart::kHead), labels);
  located.frame.neck_W = head->neck_W;
  MeasureHead(cloud, *head, located.sizes);
  located.height_less_head_mm = HeightOf(cloud) - located.sizes.head;

  const VoxelIndices rest = VoxelsLabeled(labels, kUnlabeled);
  if (rest.empty()) return std::nullopt;
  const Cylinder torso = GrowTorso(cloud, rest, head->neck_W);
  const Cylinder with_rim = GrowCylinder(cloud, rest, torso, kRimShare, kAnyLength);
  SetLabel(VoxelsInside(cloud, rest, with_rim), LabelOf(BodyPart::kTorso), labels);
  MeasureTorso(torso, located.sizes);

  std::optional<Regions> limbs = FindLimbs(cloud, labels);
  if (!limbs) return std::nullopt;
  const Vector3 side_W = SortLimbs(torso, *limbs);
  located.R_WT << side_W.cross(-torso.axis_W), side_W, -torso.axis_W;
  for (int limb = 0; limb < kLimbCount; ++limb) LabelLimb(cloud, (*limbs)[limb], limb, located);
  MeasureLowerLengths(cloud, located);
  return located;
}

}  // namespace mocap::mikic2003

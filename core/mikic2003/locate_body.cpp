#include "core/mikic2003/locate_body.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/mikic2003/find_head.h"
#include "core/mikic2003/part_widths.h"
#include "core/mikic2003/size_network.h"

namespace mocap::mikic2003 {
namespace {

constexpr double kAverageStatureMm = 1700;
// Small templates to be grown.
constexpr double kSmallTorsoMm = 150, kSmallTorsoRadiusMm = 60;
constexpr double kSmallLimbMm = 60, kSmallLimbRadiusMm = 30;
// Growth ends where a step "starts including empty voxels": where less than this is flesh. With
// half of a trunk's step, its width would be that of the trunk and both arms; the end of a limb's
// upper part is rounder.
constexpr double kTrunkShare = 0.8, kLimbShare = 0.5;
// Two standard deviations of a chest's breadth among people of one stature (ANSUR, Gordon et al.
// 1989).
constexpr double kTrunkVariation = 0.15;
// Two pieces of a section are legs if they are of similar size. A hand beside a thigh is smaller.
constexpr double kSimilar = 0.4;
constexpr double kAnyLength = std::numeric_limits<double>::infinity();
// A smaller share of the body is a stray piece of the torso and no limb. Forearm and hand have
// 0.022 of a body's mass (Winter 2009, Table 4.1); a part of them may be in the torso's template.
constexpr double kLeastLimbShare = 0.015;

const BodySizes kAverage = AverageSizes(kAverageStatureMm);

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

// Arms beside the trunk may be in its template: its dimensions are bounded by those of people of
// that height.
void MeasureTorso(const Cylinder& torso, double height_mm, BodySizes& sizes) {
  const auto bounded = [](double measured_mm, double average_mm) {
    return std::clamp(measured_mm, (1 - kTrunkVariation) * average_mm,
                      (1 + kTrunkVariation) * average_mm);
  };
  const BodySizes expected = AverageSizes(height_mm);
  sizes.torso = torso.length_mm;
  sizes.torso_width =
      bounded(2 * std::max(torso.half_width_mm, torso.half_depth_mm), expected.torso_width);
  sizes.torso_depth =
      bounded(2 * std::min(torso.half_width_mm, torso.half_depth_mm), expected.torso_depth);
  // Fig. 3: joints lie at fixed shares of the torso's width, here those of average people.
  sizes.shoulder_width = sizes.torso_width * kAverage.shoulder_width / kAverage.torso_width;
  sizes.hip_width = sizes.torso_width * kAverage.hip_width / kAverage.torso_width;
}

// Voxels in sections of a voxel's thickness across the torso's axis, from its end on.
std::vector<VoxelIndices> SectionsBelow(const VoxelCloud& cloud, const Cylinder& torso,
                                        std::span<const int> voxels) {
  std::vector<VoxelIndices> sections;
  for (const int voxel : voxels) {
    const double below_mm = torso.axis_W.dot(cloud.voxels()[voxel].center_W - torso.End());
    if (below_mm < 0) continue;
    const auto section = static_cast<std::size_t>(below_mm / cloud.voxel_mm());
    if (section >= sections.size()) sections.resize(section + 1);
    sections[section].push_back(voxel);
  }
  return sections;
}

// "In the direction of the legs, the growing will stop at the place where legs part": gives the
// torso what lies below its template, section by section, until a section falls into two pieces.
void GrowToTheLegs(const VoxelCloud& cloud, const Cylinder& torso, Labels& labels) {
  const auto sections = SectionsBelow(cloud, torso, VoxelsLabeled(labels, kUnlabeled));
  for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
    // A slanted section is connected only together with the next.
    VoxelIndices both = sections[i];
    both.insert(both.end(), sections[i + 1].begin(), sections[i + 1].end());
    const std::vector<VoxelIndices> pieces = ConnectedRegions(cloud, both);
    if (pieces.empty()) return;
    const auto largest = static_cast<double>(pieces[0].size());
    if (pieces.size() > 1 && static_cast<double>(pieces[1].size()) > kSimilar * largest) return;
    VoxelIndices of_torso = pieces[0];
    std::erase_if(of_torso, [&](int voxel) {
      return torso.axis_W.dot(cloud.voxels()[voxel].center_W - torso.End()) >=
             static_cast<double>(i + 1) * cloud.voxel_mm();
    });
    SetLabel(of_torso, LabelOf(BodyPart::kTorso), labels);
  }
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
      RoundCylinder(region.root_W, average.axis_W, kSmallLimbMm, kSmallLimbRadiusMm), kLimbShare,
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

void LocateLimb(const VoxelCloud& cloud, const Region& region, int limb, LocatedBody& located) {
  const Limb& parts = kLimbs[limb];
  const Cylinder upper = GrowUpper(cloud, region, parts);
  SetLabel(VoxelsInside(cloud, region.voxels, upper), LabelOf(parts.upper), located.frame.labels);
  const VoxelIndices lower = FindLower(cloud, located.frame.labels, region, upper);
  SetLabel(lower, LabelOf(parts.lower), located.frame.labels);
  located.frame.upper_axes_W[limb] = upper.axis_W;
  // Both sides have one size: the mean of their measurements.
  located.sizes.*parts.upper_length += upper.length_mm / 2;
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
  return GrowCylinder(cloud, voxels, small, kTrunkShare, kAnyLength);
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
  const double height_mm = HeightOf(cloud);
  located.height_less_head_mm = height_mm - located.sizes.head;

  const VoxelIndices rest = VoxelsLabeled(labels, kUnlabeled);
  if (rest.empty()) return std::nullopt;
  const Cylinder torso = GrowTorso(cloud, rest, head->neck_W);
  // A rim that is left would connect the limbs: a voxel that touches the template belongs to it.
  const double rim_mm = std::numbers::sqrt3 * cloud.voxel_mm();
  SetLabel(VoxelsInside(cloud, rest, RoundWithRim(torso, rim_mm)), LabelOf(BodyPart::kTorso),
           labels);
  GrowToTheLegs(cloud, torso, labels);
  MeasureTorso(torso, height_mm, located.sizes);

  std::optional<Regions> limbs = FindLimbs(cloud, labels);
  if (!limbs) return std::nullopt;
  const Vector3 side_W = SortLimbs(torso, *limbs);
  located.R_WT << side_W.cross(-torso.axis_W), side_W, -torso.axis_W;
  for (int limb = 0; limb < kLimbCount; ++limb) LocateLimb(cloud, (*limbs)[limb], limb, located);
  MeasureLowerLengths(cloud, located);
  MeasureLimbWidths(cloud, labels, located.sizes);
  return located;
}

}  // namespace mocap::mikic2003

#include "core/mikic2003/label_voxels.h"

#include <algorithm>

#include "core/mikic2003/cylinder.h"
#include "core/mikic2003/find_head.h"

namespace mocap::mikic2003 {
namespace {

// The paper limits the search "to some neighborhood": here 4 m/s for 0.1 s, as a person runs.
constexpr double kHeadSearchMm = 400;

// Limbs are not cylinders. The template is twice as wide as the limb, so that the limb's rim is not
// taken for the lower part.
constexpr double kTemplateShare = 2;

// Mean and covariance of a solid [mm, mm²].
struct Solid {
  double volume;
  Vector3 mean_W;
  Matrix3 covariance;
};

Solid CylinderBetween(const Vector3& from_W, const Vector3& to_W, double width_mm) {
  const double length_mm = (to_W - from_W).norm();
  const Vector3 axis_W = (to_W - from_W).normalized();
  const double along = length_mm * length_mm / 12;
  const double across = width_mm * width_mm / 16;
  return {length_mm * width_mm * width_mm, (from_W + to_W) / 2,
          across * Matrix3::Identity() + (along - across) * axis_W * axis_W.transpose()};
}

Solid Join(const Solid& a, const Solid& b) {
  const double volume = a.volume + b.volume;
  const double share = volume > 0 ? b.volume / volume : 0.5;
  const Vector3 apart_W = b.mean_W - a.mean_W;
  return {volume, a.mean_W + share * apart_W,
          (1 - share) * a.covariance + share * b.covariance +
              share * (1 - share) * apart_W * apart_W.transpose()};
}

// Distance to a limb whose voxels' places are uncertain by a voxel.
class LimbDistance {
 public:
  LimbDistance(const Solid& limb, double voxel_mm)
      : mean_W_(limb.mean_W),
        information_((limb.covariance + voxel_mm * voxel_mm * Matrix3::Identity()).inverse()) {}

  double SquaredTo(const Vector3& p_WQ) const {
    const Vector3 offset = p_WQ - mean_W_;
    return offset.dot(information_ * offset);
  }

 private:
  Vector3 mean_W_;
  Matrix3 information_;
};

// Fig. 7: from the neck through the centroid of everything but the head.
Cylinder LocateTorso(const VoxelCloud& cloud, const BodySizes& sizes, const VoxelIndices& rest,
                     const Vector3& neck_W) {
  const Vector3 down_W = (CentroidOf(cloud, rest) - neck_W).normalized();
  const double radius_mm = std::max(sizes.torso_width, sizes.torso_depth) / 2;
  return FitCylinder(cloud, rest, RoundCylinder(neck_W, down_W, sizes.torso, radius_mm));
}

// Fig. 8 (f). Voxels behind the root, or not connected with the upper part's end, belong to the
// torso's rim, which the template missed, and not to a limb.
void LabelLimb(const VoxelCloud& cloud, const BodyModel& body, const VoxelIndices& voxels,
               const Vector3& root_W, int limb, LabeledFrame& frame) {
  const Limb& parts = kLimbs[limb];
  const Vector3 to_centroid_W = CentroidOf(cloud, voxels) - root_W;
  if (voxels.empty() || to_centroid_W.norm() < 1) return;
  const Cylinder upper = FitCylinder(
      cloud, voxels,
      RoundCylinder(root_W, to_centroid_W.normalized(), body.sizes().*parts.upper_length,
                    kTemplateShare * body.sizes().*parts.upper_width / 2));
  VoxelIndices rest;
  for (const int voxel : voxels) {
    const Vector3& p_W = cloud.voxels()[voxel].center_W;
    if (!upper.Contains(p_W) && (p_W - root_W).dot(upper.axis_W) > 0) rest.push_back(voxel);
  }
  SetLabel(VoxelsInside(cloud, voxels, upper), LabelOf(parts.upper), frame.labels);
  SetLabel(PieceNearest(cloud, rest, upper.End()), LabelOf(parts.lower), frame.labels);
  frame.upper_axes_W[limb] = upper.axis_W;
}

}  // namespace

PoseState MoveToTorso(const BodyModel& body, const PoseState& predicted, const Vector3& neck_W,
                      const Vector3& down_W) {
  PoseState moved = predicted;
  const Vector3 up_W = predicted.X_WT.R.col(2);
  moved.X_WT.R = RotationBetween(up_W, -down_W) * predicted.X_WT.R;
  const Vector3 neck_T = body.reference_points_T().col(static_cast<int>(Point::kNeck));
  moved.X_WT.p = neck_W - moved.X_WT.R * neck_T;
  return moved;
}

std::array<VoxelIndices, kLimbCount> AssignToLimbs(const VoxelCloud& cloud,
                                                   std::span<const int> voxels,
                                                   const BodyModel& body, const PoseState& pose) {
  const BodyPoints points_W = body.PointsAt(body.PostureAt(pose));
  const auto at = [&](Point point) { return Vector3(points_W.col(static_cast<int>(point))); };
  std::vector<LimbDistance> distances;
  for (const Limb& limb : kLimbs) {
    distances.emplace_back(
        Join(CylinderBetween(at(limb.root), at(limb.joint), body.sizes().*limb.upper_width),
             CylinderBetween(at(limb.joint), at(limb.end), body.sizes().*limb.lower_width)),
        cloud.voxel_mm());
  }
  std::array<VoxelIndices, kLimbCount> limbs;
  for (const int voxel : voxels) {
    const Vector3& p_W = cloud.voxels()[voxel].center_W;
    const auto nearest = std::ranges::min_element(
        distances, {}, [&](const LimbDistance& limb) { return limb.SquaredTo(p_W); });
    limbs[nearest - distances.begin()].push_back(voxel);
  }
  return limbs;
}

std::optional<LabeledTrunk> LabelTrunk(const VoxelCloud& cloud, const BodyModel& body,
                                       const PoseState& predicted) {
  const Vector3 expected_head_W =
      body.PointsAt(body.PostureAt(predicted)).col(static_cast<int>(Point::kHead));
  const auto head = FindHead(cloud, CrustOf(body.sizes(), cloud.voxel_mm()),
                             SearchRegion{expected_head_W, kHeadSearchMm});
  if (!head) return std::nullopt;
  LabeledTrunk trunk;
  trunk.labels.assign(cloud.size(), kUnlabeled);
  SetLabel(head->voxels, LabelOf(BodyPart::kHead), trunk.labels);
  trunk.neck_W = head->neck_W;

  const VoxelIndices rest = VoxelsLabeled(trunk.labels, kUnlabeled);
  const Cylinder torso = LocateTorso(cloud, body.sizes(), rest, head->neck_W);
  const VoxelIndices torso_voxels =
      VoxelsInside(cloud, rest, RoundWithRim(torso, cloud.voxel_mm()));
  if (torso_voxels.empty()) return std::nullopt;
  SetLabel(torso_voxels, LabelOf(BodyPart::kTorso), trunk.labels);
  trunk.down_W = torso.axis_W;
  return trunk;
}

LabeledFrame LabelLimbs(const VoxelCloud& cloud, const BodyModel& body, const LabeledTrunk& trunk,
                        const PoseState& predicted) {
  LabeledFrame frame{.labels = trunk.labels, .neck_W = trunk.neck_W};
  const PoseState moved = MoveToTorso(body, predicted, trunk.neck_W, trunk.down_W);
  const BodyPoints moved_points_W = body.PointsAt(body.PostureAt(moved));
  const auto limbs = AssignToLimbs(cloud, VoxelsLabeled(frame.labels, kUnlabeled), body, moved);
  for (int limb = 0; limb < kLimbCount; ++limb) {
    const Vector3 root_W = moved_points_W.col(static_cast<int>(kLimbs[limb].root));
    frame.upper_axes_W[limb] =
        (moved_points_W.col(static_cast<int>(kLimbs[limb].joint)) - root_W).normalized();
    LabelLimb(cloud, body, limbs[limb], root_W, limb, frame);
  }
  return frame;
}

}  // namespace mocap::mikic2003

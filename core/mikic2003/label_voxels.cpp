#include "core/mikic2003/label_voxels.h"

#include <algorithm>

#include "core/mikic2003/cylinder.h"
#include "core/mikic2003/find_head.h"

namespace mocap::mikic2003 {
namespace {

// The paper limits the search "to some neighborhood": here 4 m/s for 0.1 s, as a person runs.
constexpr double kHeadSearchMm = 400;

// Limbs are not cylinders. The template is wider than the limb, so that the limb's rim is not taken
// for the lower part.
constexpr double kTemplateShare = 1.5;
// Variance of a voxel's position, as of a measured point [mm²].
constexpr double kMeasurementVariance = 50.0 * 50.0;

// One part of a limb: mean and covariance of a solid cylinder with an uncertain position.
class PartDistance {
 public:
  PartDistance(const Vector3& from_W, const Vector3& to_W, double width_mm,
               const Matrix3& place_covariance)
      : center_W_((from_W + to_W) / 2) {
    const Vector3 axis_W = (to_W - from_W).normalized();
    const double along = (to_W - from_W).squaredNorm() / 12;
    const double across = width_mm * width_mm / 16;
    const Matrix3 shape =
        across * Matrix3::Identity() + (along - across) * axis_W * axis_W.transpose();
    information_ =
        (shape + place_covariance + kMeasurementVariance * Matrix3::Identity()).inverse();
  }

  double SquaredTo(const Vector3& p_WQ) const {
    const Vector3 offset = p_WQ - center_W_;
    return offset.dot(information_ * offset);
  }

 private:
  Vector3 center_W_;
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
                                                   const BodyModel& body, const PoseState& pose,
                                                   const PartCovariances& part_covariances) {
  const BodyPoints points_W = body.PointsAt(body.PostureAt(pose));
  const auto at = [&](Point point) { return Vector3(points_W.col(static_cast<int>(point))); };
  std::vector<PartDistance> distances;
  for (int i = 0; i < kLimbCount; ++i) {
    const Limb& limb = kLimbs[i];
    distances.emplace_back(at(limb.root), at(limb.joint), body.sizes().*limb.upper_width,
                           part_covariances[2 * i]);
    distances.emplace_back(at(limb.joint), at(limb.end), body.sizes().*limb.lower_width,
                           part_covariances[2 * i + 1]);
  }
  std::array<VoxelIndices, kLimbCount> limbs;
  for (const int voxel : voxels) {
    const Vector3& p_W = cloud.voxels()[voxel].center_W;
    const auto nearest = std::ranges::min_element(
        distances, {}, [&](const PartDistance& part) { return part.SquaredTo(p_W); });
    limbs[(nearest - distances.begin()) / 2].push_back(voxel);
  }
  return limbs;
}

std::optional<LabeledFrame> LabelVoxels(const VoxelCloud& cloud, const BodyModel& body,
                                        const PoseState& predicted,
                                        const PartCovariances& part_covariances) {
  LabeledFrame frame;
  frame.labels.assign(cloud.size(), kUnlabeled);
  const Vector3 expected_head_W =
      body.PointsAt(body.PostureAt(predicted)).col(static_cast<int>(Point::kHead));
  const auto head = FindHead(cloud, CrustOf(body.sizes(), cloud.voxel_mm()),
                             SearchRegion{expected_head_W, kHeadSearchMm});
  if (!head) return std::nullopt;
  SetLabel(head->voxels, LabelOf(BodyPart::kHead), frame.labels);
  frame.neck_W = head->neck_W;

  const VoxelIndices rest = VoxelsLabeled(frame.labels, kUnlabeled);
  const Cylinder torso = LocateTorso(cloud, body.sizes(), rest, head->neck_W);
  const VoxelIndices torso_voxels = VoxelsInside(cloud, rest, torso);
  if (torso_voxels.empty()) return std::nullopt;
  SetLabel(torso_voxels, LabelOf(BodyPart::kTorso), frame.labels);

  const PoseState moved = MoveToTorso(body, predicted, head->neck_W, torso.axis_W);
  const BodyPoints moved_points_W = body.PointsAt(body.PostureAt(moved));
  const auto limbs =
      AssignToLimbs(cloud, VoxelsLabeled(frame.labels, kUnlabeled), body, moved, part_covariances);
  for (int limb = 0; limb < kLimbCount; ++limb) {
    const Vector3 root_W = moved_points_W.col(static_cast<int>(kLimbs[limb].root));
    frame.upper_axes_W[limb] =
        (moved_points_W.col(static_cast<int>(kLimbs[limb].joint)) - root_W).normalized();
    LabelLimb(cloud, body, limbs[limb], root_W, limb, frame);
  }
  return frame;
}

}  // namespace mocap::mikic2003

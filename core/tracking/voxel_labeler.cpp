#include "core/tracking/voxel_labeler.h"

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

constexpr double kHeadSearchMm = 220;
constexpr double kFewestLitres = 0.15;  // a part with less flesh gives no measurement
constexpr double kFarShare = 0.06;      // of a limb's voxels make up its end

// The four limbs: their two parts and the points that they measure.
struct LimbParts {
  BodyPart upper, lower;
  Point root, joint, end;
};
constexpr std::array<LimbParts, 4> kLimbs = {
    LimbParts{BodyPart::kUpperArmL, BodyPart::kLowerArmL, Point::kShoulderL, Point::kElbowL,
              Point::kFingertipsL},
    LimbParts{BodyPart::kUpperArmR, BodyPart::kLowerArmR, Point::kShoulderR, Point::kElbowR,
              Point::kFingertipsR},
    LimbParts{BodyPart::kThighL, BodyPart::kCalfL, Point::kHipL, Point::kKneeL, Point::kFootL},
    LimbParts{BodyPart::kThighR, BodyPart::kCalfR, Point::kHipR, Point::kKneeR, Point::kFootR}};

double WidthOf(const BodySizes& sizes, BodyPart part) {
  switch (part) {
    case BodyPart::kUpperArmL:
    case BodyPart::kUpperArmR:
      return sizes.upper_arm_width;
    case BodyPart::kLowerArmL:
    case BodyPart::kLowerArmR:
      return sizes.lower_arm_width;
    case BodyPart::kThighL:
    case BodyPart::kThighR:
      return sizes.thigh_width;
    default:
      return sizes.calf_width;
  }
}

// A limb part as a Gaussian: spread along its bone and across it.
struct Blob {
  Vector3 center_W;
  Vector3 axis_W;
  double along_variance;
  double across_variance;

  Blob(const Vector3& a_W, const Vector3& b_W, double width_mm)
      : center_W((a_W + b_W) / 2),
        axis_W((b_W - a_W).normalized()),
        along_variance((b_W - a_W).squaredNorm() / 12),
        across_variance(width_mm * width_mm / 8) {}

  double SquaredMahalanobis(const Vector3& p_W) const {
    const Vector3 offset = p_W - center_W;
    const double along = offset.dot(axis_W);
    return along * along / along_variance +
           (offset.squaredNorm() - along * along) / across_variance;
  }
};

}  // namespace

const LabeledVoxels& VoxelLabeler::Label(const VoxelCloud& cloud, const BodyModel& body,
                                         const PoseState& predicted) {
  cloud_ = &cloud;
  body_ = &body;
  labeled_.part.assign(cloud.size(), LabeledVoxels::kNone);
  labeled_.points_W.fill(std::nullopt);
  const BodyPoints predicted_W = body.PointsAt(body.PostureAt(predicted));
  if (!LabelHead(predicted_W.col(static_cast<int>(Point::kHead)))) return labeled_;
  const PoseState moved = LabelTorso(predicted);
  LabelLimbs(moved);
  const BodyPoints moved_W = body.PointsAt(body.PostureAt(moved));
  for (int limb = 0; limb < 4; ++limb) SplitLimb(limb, moved_W);
  MeasureCentroids();
  return labeled_;
}

bool VoxelLabeler::LabelHead(const Vector3& predicted_W) {
  const std::optional<HeadFit> head = FindHead(
      *cloud_, CrustOf(body_->sizes()), {.center_W = predicted_W, .radius_mm = kHeadSearchMm});
  if (!head) return false;
  head_ = *head;
  for (const int index : head_.voxels) {
    labeled_.part[index] = static_cast<std::int8_t>(BodyPart::kHead);
  }
  labeled_.points_W[static_cast<int>(Point::kHead)] = head_.center_W;
  rest_.clear();
  for (int i = 0; i < cloud_->size(); ++i) {
    if (labeled_.part[i] == LabeledVoxels::kNone) rest_.push_back(i);
  }
  return true;
}

PoseState VoxelLabeler::LabelTorso(const PoseState& predicted) {
  const BodySizes& sizes = body_->sizes();
  const Vector3 neck_T = body_->reference_points_T().col(static_cast<int>(Point::kNeck));
  const Vector3 head_T = body_->reference_points_T().col(static_cast<int>(Point::kHead));
  const Vector3 neck_W = head_.center_W + predicted.X_WT.R * (neck_T - head_T);
  const Cylinder torso =
      FitCylinder(*cloud_, rest_,
                  RoundCylinder(neck_W, (CentroidOf(*cloud_, rest_) - neck_W).normalized(),
                                sizes.torso, sizes.torso_width / 2));
  for (const int index : rest_) {
    if (!torso.Contains(cloud_->voxels()[index].center_W)) continue;
    labeled_.part[index] = static_cast<std::int8_t>(BodyPart::kTorso);
  }
  labeled_.points_W[static_cast<int>(Point::kNeck)] = neck_W;

  // The torso leans as its template does and keeps its heading; the limbs' angles stay.
  PoseState moved = predicted;
  const Vector3 up_W = predicted.X_WT.R.col(2);
  moved.X_WT.R =
      Eigen::Quaterniond::FromTwoVectors(up_W, -torso.axis_W).toRotationMatrix() * predicted.X_WT.R;
  moved.X_WT.p = neck_W - moved.X_WT.R * neck_T;
  return moved;
}

void VoxelLabeler::LabelLimbs(const PoseState& moved) {
  const BodyPoints points_W = body_->PointsAt(body_->PostureAt(moved));
  const auto at = [&](Point point) { return Vector3(points_W.col(static_cast<int>(point))); };
  std::vector<Blob> blobs;
  for (const LimbParts& limb : kLimbs) {
    blobs.emplace_back(at(limb.root), at(limb.joint), WidthOf(body_->sizes(), limb.upper));
    blobs.emplace_back(at(limb.joint), at(limb.end), WidthOf(body_->sizes(), limb.lower));
  }
  for (std::vector<int>& limb : limbs_) limb.clear();
  for (const int index : rest_) {
    if (labeled_.part[index] != LabeledVoxels::kNone) continue;
    const Vector3& p_W = cloud_->voxels()[index].center_W;
    const auto nearest =
        std::min_element(blobs.begin(), blobs.end(), [&](const Blob& a, const Blob& b) {
          return a.SquaredMahalanobis(p_W) < b.SquaredMahalanobis(p_W);
        });
    limbs_[(nearest - blobs.begin()) / 2].push_back(index);
  }
}

void VoxelLabeler::SplitLimb(int limb, const BodyPoints& moved_W) {
  const LimbParts& parts = kLimbs[limb];
  const Vector3 root_W = moved_W.col(static_cast<int>(parts.root));
  const Vector3 joint_W = moved_W.col(static_cast<int>(parts.joint));
  const double length_mm = (joint_W - root_W).norm();
  const Cylinder upper =
      FitCylinder(*cloud_, limbs_[limb],
                  RoundCylinder(root_W, (joint_W - root_W) / length_mm, length_mm,
                                0.75 * WidthOf(body_->sizes(), parts.upper)));
  const Vector3 hinge_W = root_W + length_mm * upper.axis_W;
  const Blob upper_blob(root_W, hinge_W, WidthOf(body_->sizes(), parts.upper));
  const Vector3 end_W = moved_W.col(static_cast<int>(parts.end));
  const Blob lower_blob(hinge_W, hinge_W + end_W - joint_W, WidthOf(body_->sizes(), parts.lower));
  std::vector<int> lower;
  for (const int index : limbs_[limb]) {
    const Vector3& p_W = cloud_->voxels()[index].center_W;
    const bool in_upper = upper.Contains(p_W) ||
                          upper_blob.SquaredMahalanobis(p_W) < lower_blob.SquaredMahalanobis(p_W);
    labeled_.part[index] = static_cast<std::int8_t>(in_upper ? parts.upper : parts.lower);
    if (!in_upper) lower.push_back(index);
  }
  labeled_.points_W[static_cast<int>(parts.root)] = root_W;
  const double voxel_litres = std::pow(cloud_->voxel_mm(), 3) * 1e-6;
  if (static_cast<double>(lower.size()) * voxel_litres < kFewestLitres) return;
  labeled_.points_W[static_cast<int>(parts.joint)] = hinge_W;
  labeled_.points_W[static_cast<int>(parts.end)] = FarEnd(lower, hinge_W);
}

Vector3 VoxelLabeler::FarEnd(const std::vector<int>& voxels, const Vector3& from_W) const {
  const Vector3 along_W = (CentroidOf(*cloud_, voxels) - from_W).normalized();
  std::vector<int> farthest = voxels;
  const std::size_t count =
      std::max<std::size_t>(1, static_cast<std::size_t>(kFarShare * voxels.size()));
  std::partial_sort(farthest.begin(), farthest.begin() + static_cast<std::ptrdiff_t>(count),
                    farthest.end(), [&](int a, int b) {
                      const double to_a = along_W.dot(cloud_->voxels()[a].center_W);
                      const double to_b = along_W.dot(cloud_->voxels()[b].center_W);
                      return to_a != to_b ? to_a > to_b : a < b;
                    });
  farthest.resize(count);
  return CentroidOf(*cloud_, farthest);
}

void VoxelLabeler::MeasureCentroids() {
  std::array<Vector3, kBodyPartCount> sums;
  sums.fill(Vector3::Zero());
  std::array<int, kBodyPartCount> counts{};
  for (int i = 0; i < cloud_->size(); ++i) {
    const int part = labeled_.part[i];
    if (part < 0) continue;
    sums[part] += cloud_->voxels()[i].center_W;
    ++counts[part];
  }
  const double voxel_litres = std::pow(cloud_->voxel_mm(), 3) * 1e-6;
  for (int part = 0; part < kBodyPartCount; ++part) {
    if (counts[part] * voxel_litres < kFewestLitres) continue;
    labeled_.points_W[part] = sums[part] / counts[part];
  }
}

}  // namespace mocap

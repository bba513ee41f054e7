#include "core/tracking/voxel_labeler.h"

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

constexpr double kHeadSearchMm = 100;
constexpr double kFewestLitres = 0.15;  // a part with less flesh gives no measurement
constexpr double kFarShare = 0.06;      // of a lower limb's voxels make up its end

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

}  // namespace

const LabeledVoxels& VoxelLabeler::Label(const VoxelCloud& cloud, const BodyModel& body,
                                         const PoseState& pose) {
  cloud_ = &cloud;
  body_ = &body;
  points_W_ = body.PointsAt(body.PostureAt(pose));
  labeled_.part.assign(cloud.size(), LabeledVoxels::kNone);
  labeled_.points_W.fill(std::nullopt);
  LabelHead();
  LabelTorso();
  LabelLimbs();
  for (int limb = 0; limb < 4; ++limb) MeasureLimb(limb);
  MeasureCentroids();
  return labeled_;
}

void VoxelLabeler::LabelHead() {
  const Vector3 expected_W = At(Point::kHead);
  neck_W_ = At(Point::kNeck);
  const std::optional<HeadFit> head = FindHead(
      *cloud_, CrustOf(body_->sizes()), {.center_W = expected_W, .radius_mm = kHeadSearchMm});
  if (head && head->score > 0) {
    for (const int index : head->voxels) {
      labeled_.part[index] = static_cast<std::int8_t>(BodyPart::kHead);
    }
    neck_W_ += head->center_W - expected_W;
    Measure(Point::kHead, head->center_W);
    Measure(Point::kNeck, neck_W_);
  }
  rest_.clear();
  for (int i = 0; i < cloud_->size(); ++i) {
    if (labeled_.part[i] == LabeledVoxels::kNone) rest_.push_back(i);
  }
}

void VoxelLabeler::LabelTorso() {
  const BodySizes& sizes = body_->sizes();
  const Vector3 down_W = (CentroidOf(*cloud_, rest_) - neck_W_).normalized();
  const Cylinder torso = FitCylinder(
      *cloud_, rest_, RoundCylinder(neck_W_, down_W, sizes.torso, sizes.torso_width / 2));
  for (const int index : rest_) {
    if (!torso.Contains(cloud_->voxels()[index].center_W)) continue;
    labeled_.part[index] = static_cast<std::int8_t>(BodyPart::kTorso);
  }
}

// Upper and lower part of each limb in turn.
void VoxelLabeler::PoseLimbs() {
  capsules_.clear();
  const auto add = [&](Point from, Point to, BodyPart part) {
    const double radius_mm = WidthOf(body_->sizes(), part) / 2;
    capsules_.emplace_back(At(from), At(to), radius_mm, radius_mm);
  };
  for (const LimbParts& limb : kLimbs) {
    add(limb.root, limb.joint, limb.upper);
    add(limb.joint, limb.end, limb.lower);
  }
}

// By distance from the parts' surfaces: by the Mahalanobis distance, thick thighs took hands that
// hang beside them.
void VoxelLabeler::LabelLimbs() {
  PoseLimbs();
  for (std::vector<int>& lower : lowers_) lower.clear();
  for (const int index : rest_) {
    if (labeled_.part[index] != LabeledVoxels::kNone) continue;
    const Vector3& p_W = cloud_->voxels()[index].center_W;
    const auto nearest = std::ranges::min_element(capsules_, {}, [&](const PosedCapsule& capsule) {
      return capsule.DistanceTo(p_W).outside_mm;
    });
    const auto place = nearest - capsules_.begin();
    const LimbParts& limb = kLimbs[place / 2];
    const bool is_lower = place % 2 == 1;
    labeled_.part[index] = static_cast<std::int8_t>(is_lower ? limb.lower : limb.upper);
    if (is_lower) lowers_[place / 2].push_back(index);
  }
}

void VoxelLabeler::MeasureLimb(int limb) {
  const LimbParts& parts = kLimbs[limb];
  Measure(parts.root, At(parts.root));
  const std::vector<int>& lower = lowers_[limb];
  if (!IsEnough(lower.size())) return;
  Measure(parts.joint, At(parts.joint));
  Measure(parts.end, FarEnd(lower, At(parts.joint)));
}

bool VoxelLabeler::IsEnough(std::size_t voxels) const {
  return static_cast<double>(voxels) * std::pow(cloud_->voxel_mm(), 3) * 1e-6 >= kFewestLitres;
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
  std::array<std::size_t, kBodyPartCount> counts{};
  for (int i = 0; i < cloud_->size(); ++i) {
    const int part = labeled_.part[i];
    if (part < 0) continue;
    sums[part] += cloud_->voxels()[i].center_W;
    ++counts[part];
  }
  for (int part = 0; part < kBodyPartCount; ++part) {
    if (!IsEnough(counts[part])) continue;
    labeled_.points_W[part] = sums[part] / static_cast<double>(counts[part]);
  }
}

}  // namespace mocap

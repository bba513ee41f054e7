#include "tools/accuracy/true_subject.h"

#include <algorithm>

#include "core/body/stance.h"

namespace mocap {
namespace {

using mikic2003::At;
using mikic2003::kLimbs;
using mikic2003::Limb;

// OrientedBody decides by the fit. Bent limbs decide clearly; those of the true pose may be
// straight.
constexpr ArmStance kBentArm{.raise = -60, .forward = 30, .elbow = 60};
constexpr LegStance kBentLeg{.hip = 60, .spread = 10, .knee = 70};
constexpr Stance kBent{.arm_l = kBentArm, .arm_r = kBentArm, .leg_l = kBentLeg, .leg_r = kBentLeg};
// From there to the true pose; an update goes only so far.
constexpr int kStartUpdates = 3;

Vector3 Between(const Vector3& a, const Vector3& b) { return (a + b) / 2; }

Vector3 MiddleOfHips(const TrueSubject& subject) {
  return Between(subject.At(Point::kHipL), subject.At(Point::kHipR));
}

Matrix3 TorsoRotationOf(const TrueSubject& subject) {
  const Vector3 up_W = (subject.At(Point::kNeck) - MiddleOfHips(subject)).normalized();
  const Vector3 hips_W = subject.At(Point::kHipL) - subject.At(Point::kHipR);
  const Vector3 left_W = (hips_W - hips_W.dot(up_W) * up_W).normalized();
  Matrix3 R_WT;
  R_WT << left_W.cross(up_W), left_W, up_W;
  return R_WT;
}

// Centroids lie in the middle of their bones.
mikic2003::MeasuredPoints PointsOf(const TrueSubject& subject) {
  mikic2003::MeasuredPoints points;
  for (const Point point : kScoredPoints) At(points, point) = subject.At(point);
  At(points, Point::kTorso) = Between(subject.At(Point::kNeck), MiddleOfHips(subject));
  for (const Limb& limb : kLimbs) {
    const Vector3 joint_W = subject.At(limb.joint);
    // The first ten points are the parts' centroids.
    points[static_cast<int>(limb.upper)] = Between(subject.At(limb.root), joint_W);
    points[static_cast<int>(limb.lower)] = Between(joint_W, subject.At(limb.end));
  }
  return points;
}

}  // namespace

Vector3 TrueSubject::At(Point point) const {
  return points_W.col(std::ranges::find(kScoredPoints, point) - kScoredPoints.begin());
}

BodySizes TrueSizes(const TrueSubject& subject) {
  const auto length = [&](Point a, Point b) { return (subject.At(a) - subject.At(b)).norm(); };
  BodySizes sizes = AverageSizes(subject.stature_mm);
  sizes.torso = (subject.At(Point::kNeck) - MiddleOfHips(subject)).norm();
  sizes.neck = length(Point::kHead, Point::kNeck);
  sizes.shoulder_width = length(Point::kShoulderL, Point::kShoulderR);
  sizes.hip_width = length(Point::kHipL, Point::kHipR);
  for (std::size_t i = 0; i < kLimbs.size(); i += 2) {
    const Limb &left = kLimbs[i], &right = kLimbs[i + 1];
    sizes.*left.upper_length =
        (length(left.root, left.joint) + length(right.root, right.joint)) / 2;
    sizes.*left.lower_length = (length(left.joint, left.end) + length(right.joint, right.end)) / 2;
  }
  return sizes;
}

mikic2003::OrientedBody TrueStart(const BodyModel& body, const TrueSubject& subject) {
  PoseState bent;
  bent.X_WT = {TorsoRotationOf(subject), Between(subject.At(Point::kNeck), MiddleOfHips(subject))};
  bent.theta = AnglesOf(kBent, body.table());
  const BodyPoints bent_W = body.PointsAt(body.PostureAt(bent));
  mikic2003::MeasuredPoints points;
  for (int i = 0; i < kPointCount; ++i) points[i] = bent_W.col(i);
  mikic2003::OrientedBody start(body, bent.X_WT.R, points);
  start.Update(body, points, true);
  for (int i = 0; i < kStartUpdates; ++i) {
    start.Predict(1);
    start.Update(body, PointsOf(subject), true);
  }
  return start;
}

TrueParts::TrueParts(const TrueSubject& subject) {
  const BodySizes sizes = TrueSizes(subject);
  const Matrix3 R_WT = TorsoRotationOf(subject);
  bones_.push_back(
      {BodyPart::kHead, subject.At(Point::kHead), subject.At(Point::kHead), sizes.head / 2});
  const double radius_mm = sizes.torso_depth / 2;
  for (const double side : {-1.0, 0.0, 1.0}) {
    const Vector3 aside_W = side * (sizes.torso_width / 2 - radius_mm) * R_WT.col(1);
    bones_.push_back({BodyPart::kTorso, MiddleOfHips(subject) + aside_W,
                      subject.At(Point::kNeck) + aside_W - radius_mm * R_WT.col(2), radius_mm});
  }
  for (std::size_t i = 0; i < kLimbs.size(); ++i) {
    const Limb& limb = kLimbs[i];
    const Vector3 root_W = subject.At(limb.root), joint_W = subject.At(limb.joint);
    upper_axes_W_[i] = (joint_W - root_W).normalized();
    bones_.push_back({limb.upper, root_W, joint_W, sizes.*limb.upper_width / 2});
    bones_.push_back({limb.lower, joint_W, subject.At(limb.end), sizes.*limb.lower_width / 2});
  }
}

double TrueParts::Bone::DistanceTo(const Vector3& p_WQ) const {
  const Vector3 bone_W = to_W - from_W, offset_W = p_WQ - from_W;
  const double squared = bone_W.squaredNorm();
  const double share = squared > 0 ? std::clamp(offset_W.dot(bone_W) / squared, 0.0, 1.0) : 0;
  return (offset_W - share * bone_W).norm() - radius_mm;
}

BodyPart TrueParts::PartAt(const Vector3& p_WQ) const {
  return std::ranges::min_element(bones_, {},
                                  [&](const Bone& bone) { return bone.DistanceTo(p_WQ); })
      ->part;
}

}  // namespace mocap

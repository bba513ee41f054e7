#include "tools/kinematics/posed_segments.h"

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

/// A segment whose bone goes from its joint to a target. Parents come first.
struct AimedSegment {
  Segment segment, parent;
  Point joint, target;
};

constexpr std::array<AimedSegment, 17> kAimedSegments = {{
    {Segment::kHead, Segment::kTorso, Point::kNeck, Point::kHead},
    {Segment::kShoulderL, Segment::kTorso, Point::kClavicleL, Point::kShoulderL},
    {Segment::kUpperArmL, Segment::kShoulderL, Point::kShoulderL, Point::kElbowL},
    {Segment::kLowerArmL, Segment::kUpperArmL, Point::kElbowL, Point::kLowerArmL},
    {Segment::kHandL, Segment::kLowerArmL, Point::kWristL, Point::kFingertipsL},
    {Segment::kShoulderR, Segment::kTorso, Point::kClavicleR, Point::kShoulderR},
    {Segment::kUpperArmR, Segment::kShoulderR, Point::kShoulderR, Point::kElbowR},
    {Segment::kLowerArmR, Segment::kUpperArmR, Point::kElbowR, Point::kLowerArmR},
    {Segment::kHandR, Segment::kLowerArmR, Point::kWristR, Point::kFingertipsR},
    {Segment::kThighL, Segment::kPelvis, Point::kHipL, Point::kKneeL},
    {Segment::kCalfL, Segment::kThighL, Point::kKneeL, Point::kFootL},
    {Segment::kFootL, Segment::kCalfL, Point::kAnkleL, Point::kBallL},
    {Segment::kToesL, Segment::kFootL, Point::kBallL, Point::kToeL},
    {Segment::kThighR, Segment::kPelvis, Point::kHipR, Point::kKneeR},
    {Segment::kCalfR, Segment::kThighR, Point::kKneeR, Point::kFootR},
    {Segment::kFootR, Segment::kCalfR, Point::kAnkleR, Point::kBallR},
    {Segment::kToesR, Segment::kFootR, Point::kBallR, Point::kToeR},
}};

/// The segment that carries each point that follows the 23; a joint's point, the one before it.
constexpr std::array<Segment, kFurtherPointCount> kBeforePoint = {
    Segment::kTorso, Segment::kTorso, Segment::kLowerArmL, Segment::kLowerArmR, Segment::kCalfL,
    Segment::kCalfR, Segment::kFootL, Segment::kFootR,     Segment::kFootL,     Segment::kFootR,
    Segment::kToesL, Segment::kToesR, Segment::kHandL,     Segment::kHandR};

/// Places the points that a row does not have.
void PlaceMissing(Segment segment, Point joint, const BodyPlaces& rest_T, PosedSegments& posed) {
  const auto from = static_cast<int>(joint);
  for (int i = 0; i < kFurtherPointCount; ++i) {
    auto place_W = posed.places_W.col(kPointCount + i);
    if (kBeforePoint[i] != segment || place_W.allFinite()) continue;
    place_W = posed.places_W.col(from) +
              posed.RotationOf(segment) * (rest_T.col(kPointCount + i) - rest_T.col(from));
  }
}

bool HasPoint(const PoseRow& row, Point point) {
  return static_cast<int>(point) < kPointCount || FurtherOf(row.further_W, point).allFinite();
}

}  // namespace

Matrix3 PosedSegments::RotationFromHanging(Segment segment) const {
  constexpr double kQuarter_rad = EIGEN_PI / 2;
  const bool is_left = segment == Segment::kUpperArmL || segment == Segment::kLowerArmL ||
                       segment == Segment::kHandL;
  const bool is_right = segment == Segment::kUpperArmR || segment == Segment::kLowerArmR ||
                        segment == Segment::kHandR;
  if (!is_left && !is_right) return RotationOf(segment);
  // The reference holds the arms out.
  return RotationOf(segment) *
         ExpRotation((is_left ? kQuarter_rad : -kQuarter_rad) * Vector3::UnitX());
}

SegmentPoser::SegmentPoser(const BodyRecord& body)
    : rest_(body), model_(rest_.table(), rest_.sizes()) {
  for (const JointAxis& joint : model_.table().joints) {
    const auto record = std::ranges::find(body.joints, joint.name, &JointRecord::name);
    record_place_.push_back(record - body.joints.begin());
  }
}

JointAngles SegmentPoser::AnglesIn(const PoseRow& row) const {
  JointAngles theta = JointAngles::Constant(model_.joint_count(), std::nan(""));
  for (int i = 0; i < model_.joint_count(); ++i) {
    const Eigen::Index place = record_place_[i];
    const int angle = model_.table().joints[i].paper_angle;
    if (place < row.joint_rad.size() && std::isfinite(row.joint_rad[place])) {
      theta[i] = row.joint_rad[place];
    } else if (angle > 0) {
      theta[i] = row.paper.theta_rad[angle - 1];
    }
  }
  return theta;
}

bool SegmentPoser::HasAngles(const JointAngles& theta, Segment segment, Segment parent) const {
  const BodyTable& table = model_.table();
  const int end = table.carrier[static_cast<int>(parent)];
  for (int i = table.carrier[static_cast<int>(segment)]; i >= 0 && i != end;
       i = table.joints[i].parent) {
    if (std::isnan(theta[i])) return false;
  }
  return true;
}

PosedSegments SegmentPoser::Pose(const PoseRow& row) const {
  const JointAngles theta = AnglesIn(row);
  const Posture posture = model_.PostureAt(
      {{TorsoRotation(row), row.paper.torso_mm}, theta.array().isNaN().select(0, theta)});
  const auto by_angles = [&](Segment segment) -> const Matrix3& {
    const int carrier = model_.table().carrier[static_cast<int>(segment)];
    return carrier < 0 ? posture.X_WT.R : posture.X_W[carrier].R;
  };
  const BodyPlaces& rest_T = rest_.places_T();
  const auto along = [](const BodyPlaces& places, const AimedSegment& bone) -> Vector3 {
    return places.col(static_cast<int>(bone.target)) - places.col(static_cast<int>(bone.joint));
  };
  PosedSegments posed;
  posed.places_W << row.points_W, row.further_W;
  posed.R_W[static_cast<int>(Segment::kTorso)] = posture.X_WT.R;
  posed.R_W[static_cast<int>(Segment::kPelvis)] = rest_.PelvisRotation(row);
  PlaceMissing(Segment::kTorso, Point::kTorso, rest_T, posed);
  for (const AimedSegment& bone : kAimedSegments) {
    Matrix3& R = posed.R_W[static_cast<int>(bone.segment)];
    R = posed.RotationOf(bone.parent);
    const bool is_shown = HasPoint(row, bone.joint) && HasPoint(row, bone.target);
    if (is_shown || HasAngles(theta, bone.segment, bone.parent))
      R *= by_angles(bone.parent).transpose() * by_angles(bone.segment);
    const Vector3 direction_W = along(posed.places_W, bone);
    if (direction_W.allFinite())
      R = RotationBetween(R * along(rest_T, bone), direction_W).toRotationMatrix() * R;
    PlaceMissing(bone.segment, bone.joint, rest_T, posed);
  }
  return posed;
}

}  // namespace mocap

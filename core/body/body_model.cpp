#include "core/body/body_model.h"

#include <cmath>
#include <utility>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr std::array<Segment, kPlaceCount> kSegmentOfPoint = {
    Segment::kTorso,     Segment::kHead,   Segment::kUpperArmL, Segment::kUpperArmR,
    Segment::kThighL,    Segment::kThighR, Segment::kLowerArmL, Segment::kLowerArmR,
    Segment::kCalfL,     Segment::kCalfR,  Segment::kTorso,     Segment::kShoulderL,
    Segment::kShoulderR, Segment::kPelvis, Segment::kPelvis,    Segment::kUpperArmL,
    Segment::kUpperArmR, Segment::kHandL,  Segment::kHandR,     Segment::kThighL,
    Segment::kThighR,    Segment::kCalfL,  Segment::kCalfR,     Segment::kTorso,
    Segment::kTorso,     Segment::kHandL,  Segment::kHandR,     Segment::kFootL,
    Segment::kFootR,     Segment::kFootL,  Segment::kFootR,     Segment::kFootL,
    Segment::kFootR,     Segment::kToesL,  Segment::kToesR,     Segment::kHandL,
    Segment::kHandR};

}  // namespace

BodyModel::BodyModel(BodyTable table, const BodySizes& sizes) : table_(std::move(table)) {
  MOCAP_CHECK(table_.joints.size() <= static_cast<std::size_t>(kMaxJoints));
  for (int i = 0; i < joint_count(); ++i) MOCAP_CHECK(table_.joints[i].parent < i);
  for (int i = 0; i < kPlaceCount; ++i) {
    point_carrier_[i] = table_.carrier[static_cast<int>(kSegmentOfPoint[i])];
  }
  Resize(sizes);
}

void BodyModel::Resize(const BodySizes& sizes) {
  sizes_ = sizes;
  reference_points_T_ = ReferencePoints(sizes, table_.placement);
  BuildShape(table_, sizes_, reference_points_T_, shape_);
}

int BodyModel::CarrierOf(Point point) const { return point_carrier_[static_cast<int>(point)]; }

void BodyModel::PlaceAxis(const PoseState& pose, int row, Posture& posture) const {
  const JointAxis& joint = table_.joints[row];
  const RigidTransform& X_WP = joint.parent < 0 ? pose.X_WT : posture.X_W[joint.parent];
  const Vector3 q_T = reference_points_T_.col(static_cast<int>(joint.at));
  posture.axis_W[row] = X_WP.R * joint.axis_T;
  posture.point_W[row] = X_WP * q_T;
  posture.X_W[row] = X_WP * RotationAbout(joint.axis_T, q_T, pose.theta[row]);
}

Posture BodyModel::PostureAt(const PoseState& pose) const {
  Posture posture;
  posture.X_WT = pose.X_WT;
  for (int i = 0; i < joint_count(); ++i) PlaceAxis(pose, i, posture);
  return posture;
}

void BodyModel::MoveAxes(const PoseState& pose, std::span<const int> rows, Posture& posture) const {
  for (const int row : rows) PlaceAxis(pose, row, posture);
}

void BodyModel::PoseShape(const Posture& posture, std::vector<PosedCapsule>& posed) const {
  posed.clear();
  for (const Capsule& capsule : shape_) {
    const RigidTransform& X = capsule.carrier < 0 ? posture.X_WT : posture.X_W[capsule.carrier];
    posed.emplace_back(capsule, X);
  }
}

Vector3 BodyModel::PlaceOf(Point point, const Posture& posture) const {
  const int carrier = CarrierOf(point);
  return (carrier < 0 ? posture.X_WT : posture.X_W[carrier]) *
         reference_points_T_.col(static_cast<int>(point));
}

BodyPoints BodyModel::PointsAt(const Posture& posture) const {
  BodyPoints points_W;
  for (int i = 0; i < kPointCount; ++i) points_W.col(i) = PlaceOf(static_cast<Point>(i), posture);
  return points_W;
}

FurtherPoints BodyModel::FurtherPointsAt(const Posture& posture) const {
  FurtherPoints points_W;
  for (int i = 0; i < kFurtherPointCount; ++i) {
    const auto point = static_cast<Point>(kPointCount + i);
    const bool is_moved = MovesApart(point);
    points_W.col(i) = is_moved ? PlaceOf(point, posture) : Vector3::Constant(std::nan(""));
  }
  return points_W;
}

bool BodyModel::MovesApart(Point further) const {
  const auto differ = [this](Segment one, Segment other) {
    return table_.carrier[static_cast<int>(one)] != table_.carrier[static_cast<int>(other)];
  };
  switch (kSegmentOfPoint[static_cast<int>(further)]) {
    case Segment::kHandL:
      return differ(Segment::kHandL, Segment::kLowerArmL);
    case Segment::kHandR:
      return differ(Segment::kHandR, Segment::kLowerArmR);
    case Segment::kFootL:
    case Segment::kToesL:
      return differ(Segment::kFootL, Segment::kCalfL);
    case Segment::kFootR:
    case Segment::kToesR:
      return differ(Segment::kFootR, Segment::kCalfR);
    default:  // Collarbones begin at the torso.
      return differ(further == Point::kClavicleL ? Segment::kShoulderL : Segment::kShoulderR,
                    Segment::kTorso);
  }
}

void BodyModel::PointJacobian(
    const Posture& posture, int carrier, const Vector3& p_WQ,
    Eigen::Ref<Eigen::Matrix<double, 3, Eigen::Dynamic>> J_point_by_step) const {
  J_point_by_step.setZero();
  J_point_by_step.leftCols<3>().setIdentity();
  J_point_by_step.middleCols<3>(3) = -Hat(p_WQ - posture.X_WT.p);
  for (int i = carrier; i >= 0; i = table_.joints[i].parent) {
    J_point_by_step.col(kTorsoDof + i) = posture.axis_W[i].cross(p_WQ - posture.point_W[i]);
  }
}

void BodyModel::DirectionalJacobian(const Posture& posture, int carrier, const Vector3& p_WQ,
                                    const Vector3& direction_W, PoseStep& J_by_step) const {
  J_by_step.setZero(dof());
  J_by_step.head<3>() = direction_W;
  J_by_step.segment<3>(3) = (p_WQ - posture.X_WT.p).cross(direction_W);
  for (int i = carrier; i >= 0; i = table_.joints[i].parent) {
    const Vector3 arm_W = p_WQ - posture.point_W[i];
    J_by_step[kTorsoDof + i] = posture.axis_W[i].dot(arm_W.cross(direction_W));
  }
}

PaperState BodyModel::PaperStateOf(const PoseState& pose) const {
  PaperState state;
  state.torso_mm = pose.X_WT.p;
  const Vector3 rotation = LogRotation(pose.X_WT.R);
  state.torso_angle_rad = rotation.norm();
  if (state.torso_angle_rad > 1e-9) state.torso_axis = rotation / state.torso_angle_rad;
  for (int i = 0; i < joint_count(); ++i) {
    const int angle = table_.joints[i].paper_angle;
    if (angle > 0) state.theta_rad[angle - 1] = pose.theta[i];
  }
  return state;
}

}  // namespace mocap

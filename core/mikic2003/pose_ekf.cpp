#include "core/mikic2003/pose_ekf.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace mocap::mikic2003 {
namespace {

constexpr int kAxis = 3, kAngle = 6, kJoints = 7;  // Positions of ω0, θ0, θ1 in the state.
constexpr double kMeasurementStdMm = 50;
// Speeds of people.
constexpr double kTorsoMmPerS = 1500;
constexpr double kTorsoRadPerS = 3;
constexpr double kJointRadPerS = 6;
// P[0/0].
constexpr double kStartStdMm = 100;
constexpr double kStartStdRad = 1;
constexpr double kTurnedRad = 2 * std::numbers::pi / 3;
// Iterations are linear only for small angles [rad].
constexpr double kWidestStep = 0.3;
constexpr double kStillStep = 0.01;

State StandardDeviations(double torso_mm, double torso_rad, double joint_rad) {
  State std;
  std.setConstant(joint_rad);
  std.head<3>().setConstant(torso_mm);
  std.segment<4>(kAxis).setConstant(torso_rad);
  return std;
}

// Derivative of the unit vector of an axis of any length: ∂(ω/|ω|)/∂ω.
Matrix3 UnitJacobian(const Vector3& axis) {
  const Vector3 unit = axis.normalized();
  return (Matrix3::Identity() - unit * unit.transpose()) / axis.norm();
}

Matrix3 AboutVertical(double angle_rad) { return ExpRotation(angle_rad * Vector3::UnitZ()); }

// Axis and angle of a rotation, with the sign that is closer to a given axis.
Eigen::Vector4d AxisAngleNear(const Matrix3& R, const Vector3& near_axis) {
  const Vector3 rotation = LogRotation(R);
  const double angle = rotation.norm();
  if (angle < 1e-9) return {near_axis.x(), near_axis.y(), near_axis.z(), 0};
  Eigen::Vector4d result;
  result << rotation / angle, angle;
  if (rotation.dot(near_axis) < 0) result << -rotation / angle, 2 * std::numbers::pi - angle;
  return result;
}

void HoldLimits(const BodyTable& table, State& x) {
  for (const JointAxis& joint : table.joints) {
    double& angle = x[kJoints + joint.paper_angle - 1];
    angle = std::clamp(angle, joint.min_rad, joint.max_rad);
  }
}

}  // namespace

Matrix3 TorsoRotation(const Vector3& axis, double angle_rad) {
  return ExpRotation(angle_rad * axis.normalized());
}

State StateOf(const BodyModel& body, const PoseState& pose) {
  State x = State::Zero();
  x.head<3>() = pose.X_WT.p;
  x.segment<4>(kAxis) = AxisAngleNear(pose.X_WT.R, Vector3::UnitZ());
  for (int i = 0; i < body.joint_count(); ++i) {
    x[kJoints + body.table().joints[i].paper_angle - 1] = pose.theta[i];
  }
  return x;
}

PoseState PoseOf(const BodyModel& body, const State& x) {
  PoseState pose;
  pose.X_WT.p = x.head<3>();
  pose.X_WT.R = TorsoRotation(x.segment<3>(kAxis), x[kAngle]);
  pose.theta.resize(body.joint_count());
  for (int i = 0; i < body.joint_count(); ++i) {
    pose.theta[i] = x[kJoints + body.table().joints[i].paper_angle - 1];
  }
  return pose;
}

PointJacobian DifferentiatePoint(const BodyModel& body, const State& x, const Posture& posture,
                                 Point point, const Vector3& p_WQ) {
  PointJacobian J = PointJacobian::Zero();
  J.leftCols<3>().setIdentity();
  const Vector3 p_TQ = posture.X_WT.Inverse() * p_WQ;
  const Vector3 axis = x.segment<3>(kAxis);
  const Matrix3 unit_hat = Hat(axis.normalized());
  const double sine = std::sin(x[kAngle]), cosine = std::cos(x[kAngle]);
  const Matrix3 unit_by_axis = UnitJacobian(axis);
  for (int i = 0; i < 3; ++i) {  // Eq. (17)
    const Matrix3 hat = Hat(unit_by_axis.col(i));
    const Matrix3 rotation = sine * hat + (1 - cosine) * (hat * unit_hat + unit_hat * hat);
    J.col(kAxis + i) = rotation * p_TQ;
  }
  J.col(kAngle) = (cosine * unit_hat + sine * unit_hat * unit_hat) * p_TQ;  // Eq. (18)
  // Eqs. (19)–(21): the point moves perpendicular to each of its axes.
  for (int row = body.CarrierOf(point); row >= 0; row = body.table().joints[row].parent) {
    J.col(kJoints + body.table().joints[row].paper_angle - 1) =
        posture.axis_W[row].cross(p_WQ - posture.point_W[row]);
  }
  return J;
}

PoseEkf::PoseEkf(const BodyModel& body, const PoseState& pose) : x_(StateOf(body, pose)) {
  P_ = StandardDeviations(kStartStdMm, kStartStdRad, kStartStdRad).cwiseAbs2().asDiagonal();
  TurnFrame();
}

void PoseEkf::Predict(double dt_s) {
  P_.diagonal() +=
      (dt_s * StandardDeviations(kTorsoMmPerS, kTorsoRadPerS, kJointRadPerS)).cwiseAbs2();
}

void PoseEkf::Update(const BodyModel& body, const MeasuredPoints& points_W, int iterations) {
  TurnFrame();
  std::vector<Point> seen;
  for (int i = 0; i < kPointCount; ++i) {
    if (points_W[i]) seen.push_back(static_cast<Point>(i));
  }
  if (seen.empty()) return;
  const auto size = static_cast<Eigen::Index>(3 * seen.size());
  Eigen::MatrixXd H(size, kStateSize), gain;
  Eigen::VectorXd residual(size);
  const State prior = x_;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const Posture posture = body.PostureAt(PoseOf(body, x_));
    const BodyPoints points_V = body.PointsAt(posture);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Vector3 p_V = points_V.col(static_cast<int>(seen[i]));
      residual.segment<3>(3 * i) = R_WV_.transpose() * *At(points_W, seen[i]) - p_V;
      H.middleRows<3>(3 * i) = DifferentiatePoint(body, x_, posture, seen[i], p_V);
    }
    Eigen::MatrixXd S = H * P_ * H.transpose();
    S.diagonal().array() += kMeasurementStdMm * kMeasurementStdMm;
    gain = S.llt().solve(H * P_).transpose();
    State step = prior + gain * (residual - H * (prior - x_)) - x_;
    const double widest = step.tail<kStateSize - 3>().cwiseAbs().maxCoeff();
    step *= std::min(1.0, kWidestStep / widest);
    x_ += step;
    HoldLimits(body.table(), x_);
    if (widest < kStillStep) break;
  }
  P_ = (StateCovariance::Identity() - gain * H) * P_;
  P_ = StateCovariance(0.5 * (P_ + P_.transpose()));
}

void PoseEkf::TurnFrame() {
  if (std::abs(x_[kAngle] - std::numbers::pi) < kTurnedRad) {
    x_.segment<3>(kAxis).normalize();
    return;
  }
  const Matrix3 R = AboutVertical(std::numbers::pi - x_[kAngle]);
  const auto turned = [&](const State& x) {
    State result = x;
    result.head<3>() = R * x.head<3>();
    result.segment<4>(kAxis) =
        AxisAngleNear(R * TorsoRotation(x.segment<3>(kAxis), x[kAngle]), Vector3::UnitZ());
    return result;
  };
  // Propagates the covariance to first order, by finite differences of the map.
  constexpr double kStep = 1e-5;
  StateCovariance J;
  for (int i = 0; i < kStateSize; ++i) {
    const State step = kStep * State::Unit(i);
    J.col(i) = (turned(x_ + step) - turned(x_ - step)) / (2 * kStep);
  }
  x_ = turned(x_);
  P_ = StateCovariance(J * P_ * J.transpose());
  R_WV_ = R_WV_ * R.transpose();
}

PoseState PoseEkf::Pose(const BodyModel& body) const {
  PoseState pose = PoseOf(body, x_);
  pose.X_WT = RigidTransform{R_WV_} * pose.X_WT;
  return pose;
}

Matrix3 PoseEkf::PointCovariance(const BodyModel& body, Point point) const {
  const Posture posture = body.PostureAt(PoseOf(body, x_));
  const Vector3 p_V = body.PointsAt(posture).col(static_cast<int>(point));
  const PointJacobian J = DifferentiatePoint(body, x_, posture, point, p_V);
  return R_WV_ * (J * P_ * J.transpose()) * R_WV_.transpose();
}

double SumOfDistances(const BodyModel& body, const PoseState& pose,
                      const MeasuredPoints& points_W) {
  const BodyPoints model_W = body.PointsAt(body.PostureAt(pose));
  double sum_mm = 0;
  for (int i = 0; i < kPointCount; ++i) {
    if (points_W[i]) sum_mm += (*points_W[i] - model_W.col(i)).norm();
  }
  return sum_mm;
}

}  // namespace mocap::mikic2003

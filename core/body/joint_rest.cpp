#include "core/body/joint_rest.h"

#include <iterator>

namespace mocap {
namespace {

// Sine of an arm's elevation in the frame that carries the girdle: -1 hanging, 0 level, 1 overhead.
struct Elevation {
  double sine;
  JointAngles J_by_angle;
};

// Computes the elevation of a reference direction that is moved by the axes from `first` on.
Elevation ElevationOf(const BodyTable& table, int first, Segment segment,
                      const Vector3& direction_T, const JointAngles& theta) {
  Elevation elevation{0, JointAngles::Zero(theta.size())};
  Vector3 direction = direction_T;
  // From the outermost axis inwards: each turns direction and derivatives so far.
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxJoints> J(3, theta.size());
  J.setZero();
  for (int row = table.carrier[static_cast<int>(segment)]; row >= first;
       row = table.joints[row].parent) {
    const Vector3& axis_T = table.joints[row].axis_T;
    const Matrix3 turn = ExpRotation(theta[row] * axis_T);
    direction = turn * direction;
    J = turn * J;
    J.col(row) = axis_T.cross(direction);
  }
  elevation.sine = direction.z();
  elevation.J_by_angle = J.row(2).transpose();
  return elevation;
}

}  // namespace

JointRest RestOf(const BodyTable& table, int row, const JointAngles& theta) {
  const JointAxis& joint = table.joints[row];
  if (joint.rise_rad == 0) return {joint.rest_rad, JointAngles::Zero(theta.size())};
  const bool is_left = table.Carries(row, Segment::kUpperArmL);
  const Elevation arm = ElevationOf(table, row, is_left ? Segment::kUpperArmL : Segment::kUpperArmR,
                                    is_left ? Vector3::UnitY() : Vector3(-Vector3::UnitY()), theta);
  return {joint.rest_rad + joint.rise_rad * (1 + arm.sine), joint.rise_rad * arm.J_by_angle};
}

double ChiSquareFromRest(const BodyTable& table, const JointAngles& theta) {
  double chi_square = 0;
  for (int row = 0; row < std::ssize(table.joints); ++row) {
    const double std_rad = table.joints[row].rest_std_rad;
    if (std_rad == 0) continue;
    const double deviation = (theta[row] - RestOf(table, row, theta).rest_rad) / std_rad;
    chi_square += deviation * deviation;
  }
  return chi_square;
}

}  // namespace mocap

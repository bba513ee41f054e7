#include "core/body/update_equations.h"

#include <algorithm>

#include "core/kernels/equations.h"

namespace mocap {

void UpdateEquations::Reset(int dof) {
  dof_ = dof;
  for (int j = 0; j < dof; ++j) columns_[j].fill(0);
  gradient_.setZero(dof);
}

void UpdateEquations::Add(const PoseStep& J, double residual, double variance) {
  alignas(64) Column row;
  std::copy_n(J.data(), dof_, row.begin());
  std::fill(row.begin() + dof_, row.end(), 0);
  // A measurement depends on one chain of joints: most of its row is zero.
  kernels::AddSquareAbove(row.data(), dof_, 1 / variance, kPlaces, columns_[0].data());
  gradient_ += J * (residual / variance);
}

void UpdateEquations::Weigh(double worth) {
  for (int j = 0; j < dof_; ++j)
    for (int i = 0; i <= j; ++i) columns_[j][i] *= worth;
  gradient_ *= worth;
}

const PoseCovariance& UpdateEquations::information() {
  information_.resize(dof_, dof_);
  for (int j = 0; j < dof_; ++j) {
    for (int i = 0; i <= j; ++i) information_(i, j) = information_(j, i) = columns_[j][i];
  }
  return information_;
}

void UpdateEquations::AddPoint(const Eigen::Ref<const Eigen::Matrix<double, 3, Eigen::Dynamic>>& J,
                               const Vector3& residual_mm, double variance_mm2) {
  for (int axis = 0; axis < 3; ++axis) {
    Add(J.row(axis).transpose(), residual_mm[axis], variance_mm2);
  }
}

}  // namespace mocap

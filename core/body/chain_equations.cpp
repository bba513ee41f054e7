#include "core/body/chain_equations.h"

#include <algorithm>

namespace mocap {
void ChainEquations::Reset(const BodyTable& table, const Posture& posture) {
  table_ = &table;
  posture_ = &posture;
  terms_.clear();
}

void ChainEquations::Add(int carrier, const Vector3& p_WQ, const Vector3& direction_W,
                         double residual_mm, double variance_mm2) {
  const Vector3 moment = (p_WQ - posture_->X_WT.p).cross(direction_W);
  terms_.push_back({{direction_W.x(), direction_W.y(), direction_W.z(), moment.x(), moment.y(),
                     moment.z(), residual_mm, 0},
                    variance_mm2,
                    carrier + 1});
}

void ChainEquations::AddPoint(int carrier, const Vector3& p_WQ, const Vector3& residual_mm,
                              double variance_mm2) {
  for (int axis = 0; axis < 3; ++axis)
    Add(carrier, p_WQ, Vector3::Unit(axis), residual_mm[axis], variance_mm2);
}

void ChainEquations::TakeContacts() {
  std::fill_n(contacts_.begin(), table_->joints.size() + 1, kernels::WrenchSum{});
  kernels::AddWrenches(terms_.data(), terms_.size(), contacts_.data());
  for (std::size_t i = 0; i < table_->joints.size() + 1; ++i) {
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 6; ++column)
        sums_[i].squares(row, column) = contacts_[i][row][column];
      sums_[i].pull[row] = contacts_[i][row][6];
    }
  }
}

void ChainEquations::AddTo(UpdateEquations& equations) {
  TakeContacts();
  const auto screw = [this](int joint) {
    const Vector3& axis_W = posture_->axis_W[joint];
    Wrench s;
    s << (posture_->point_W[joint] - posture_->X_WT.p).cross(axis_W), axis_W;
    return s;
  };
  // Parents precede their children.
  for (int j = static_cast<int>(table_->joints.size()) - 1; j >= 0; --j) {
    const Sum& below = SumOf(j);
    const Wrench s = screw(j);
    const Wrench moved = below.squares * s;
    const int column = kTorsoDof + j;
    for (int i = j; i >= 0; i = table_->joints[i].parent)
      equations.AddProduct(kTorsoDof + i, column, screw(i).dot(moved));
    for (int i = 0; i < kTorsoDof; ++i) equations.AddProduct(i, column, moved[i]);
    equations.AddGradient(column, s.dot(below.pull));
    Sum& parent = SumOf(table_->joints[j].parent);
    parent.squares += below.squares;
    parent.pull += below.pull;
  }
  const Sum& all = SumOf(-1);
  for (int j = 0; j < kTorsoDof; ++j) {
    for (int i = 0; i <= j; ++i) equations.AddProduct(i, j, all.squares(i, j));
    equations.AddGradient(j, all.pull[j]);
  }
}

}  // namespace mocap

// Measurements of a body's points, summed up along its chain of joints: each costs six numbers and
// not a row as long as the state.
#pragma once

#include <array>
#include <vector>

#include "core/body/body_model.h"
#include "core/tracking/pose_filter.h"

namespace mocap {

/// A wrench w and its residual r; nothing in the last place.
using WrenchRow = std::array<double, 8>;
/// Σ w (wᵀ r) / σ²: a row for each of a wrench's numbers.
using WrenchSum = std::array<WrenchRow, 6>;
/// A contact of a part.
struct WrenchTerm {
  WrenchRow row;
  double variance;
  int part;
};

/// Sums up linearised measurements of how far points of one posed body lie along directions.
///
/// A row of the Jacobian is linear in the wrench w = (n, (p - p_WT) × n) of the direction n at the
/// point p, the same way for all points that a part carries. Thus Σ w wᵀ / σ² and Σ w r / σ² are
/// summed up a part, and brought to the joints from the tips to the torso, as composite inertias
/// are (Featherstone 2008, §6.2).
class ChainEquations {
 public:
  /// Begins anew; `posture` is borrowed until the next.
  void Reset(const BodyTable& table, const Posture& posture);

  /// Adds a measurement along one direction.
  /// @param carrier      row of the axis that moves the point; -1: only the torso does.
  /// @param direction_W  need not have unit length.
  /// @param residual_mm  how far along the direction the point should go.
  void Add(int carrier, const Vector3& p_WQ, const Vector3& direction_W, double residual_mm,
           double variance_mm2);
  /// Adds a measured point with the same variance along all axes.
  void AddPoint(int carrier, const Vector3& p_WQ, const Vector3& residual_mm, double variance_mm2);

  /// Brings the sums into the equations of the pose; to be called once.
  void AddTo(UpdateEquations& equations);

 private:
  using Wrench = Eigen::Matrix<double, 6, 1>;
  struct Sum {
    Eigen::Matrix<double, 6, 6> squares;
    Wrench pull;
  };

  Sum& SumOf(int carrier) { return sums_[carrier + 1]; }
  void TakeContacts();

  const BodyTable* table_ = nullptr;
  const Posture* posture_ = nullptr;
  std::vector<WrenchTerm> terms_;
  std::array<WrenchSum, kMaxJoints + 1> contacts_;  ///< As `sums_`, of a part's own contacts.
  std::array<Sum, kMaxJoints + 1> sums_;            ///< The torso's first.
};

}  // namespace mocap

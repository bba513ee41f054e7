// Measurements of points of a body, summed along its kinematic chain. Each costs six numbers
// instead of a row as long as the state.
#pragma once

#include <array>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/update_equations.h"
#include "core/kernels/equations.h"

namespace mocap {

/// Sums linearised measurements of points of one posed body along directions.
///
/// A row of the Jacobian is linear in the wrench w = (n, (p - p_WT) × n) of direction n at point p,
/// with the same factors for all points that a part carries. So Σ w wᵀ / σ² and Σ w r / σ² are
/// summed per part and passed to the joints from the tips to the torso, like composite inertias
/// (Featherstone 2008, §6.2).
class ChainEquations {
 public:
  /// Starts again; `posture` is borrowed until the next Reset.
  void Reset(const BodyTable& table, const Posture& posture);

  /// Adds a measurement along one direction.
  /// @param carrier      row of the axis that moves the point; -1: only the torso moves it.
  /// @param direction_W  need not have unit length.
  /// @param residual_mm  distance that the point should move along the direction.
  void Add(int carrier, const Vector3& p_WQ, const Vector3& direction_W, double residual_mm,
           double variance_mm2);
  /// Adds a measured point with the same variance along all axes.
  void AddPoint(int carrier, const Vector3& p_WQ, const Vector3& residual_mm, double variance_mm2);

  /// Adds the sums to the equations of the pose. Call it once.
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
  std::vector<kernels::WrenchTerm> terms_;
  std::array<kernels::WrenchSum, kMaxJoints + 1>
      contacts_;                          ///< Like `sums_`, for a part's own contacts.
  std::array<Sum, kMaxJoints + 1> sums_;  ///< The torso's first.
};

/// What linearised measurements are added to: those of points of the body, and all others.
struct Linearisation {
  ChainEquations& chain;
  UpdateEquations& equations;
};

}  // namespace mocap

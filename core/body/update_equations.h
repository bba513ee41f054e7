// Linearised measurements of a pose, summed.
#pragma once

#include <array>

#include "core/body/pose_state.h"

namespace mocap {

/// Sums linearised measurements z - h(x) ≈ J δ as JᵀR⁻¹J and JᵀR⁻¹(z - h(x)).
class UpdateEquations {
 public:
  void Reset(int dof);
  /// Adds one scalar measurement.
  /// @param J         derivative of the prediction by a PoseStep.
  /// @param residual  measured minus predicted.
  void Add(const PoseStep& J, double residual, double variance);
  /// Adds a measured point with the same variance [mm²] along all axes; J is 3 × dof.
  void AddPoint(const Eigen::Ref<const Eigen::Matrix<double, 3, Eigen::Dynamic>>& J,
                const Vector3& residual_mm, double variance_mm2);

  /// Multiplies everything added so far, as if all variances were that much smaller.
  void Weigh(double worth);

  /// AddProduct adds to one entry JᵢᵀR⁻¹Jⱼ with i <= j, AddGradient to one of JᵀR⁻¹(z - h(x)).
  void AddProduct(int i, int j, double sum) { columns_[j][i] += sum; }
  void AddGradient(int i, double sum) { gradient_[i] += sum; }

  /// The sums of everything added; valid until the next addition.
  const PoseCovariance& information();
  const PoseStep& gradient() const { return gradient_; }

  /// Length of a vector of any body in memory, a multiple of the processor's vector length.
  static constexpr int kPlaces = (kMaxDof + 7) / 8 * 8;
  using Column = std::array<double, kPlaces>;

 private:
  int dof_ = 0;
  // The upper triangle; entries below the diagonal are undefined.
  alignas(64) std::array<Column, kMaxDof> columns_;
  PoseCovariance information_;
  PoseStep gradient_;
};

}  // namespace mocap

// How far two methods of measuring agree.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/geometry.h"

namespace mocap {

/// Agreement of two methods, by their differences (Bland and Altman 1986). NaN without values.
struct Agreement {
  std::size_t count = 0;
  double bias = 0;               ///< Mean difference: ours less the other's.
  double deviation = 0;          ///< Standard deviation of the differences.
  double lower = 0, upper = 0;   ///< Limits of agreement: bias ± 1.96 deviations.
  double rmsd = 0;               ///< Root mean square difference.
  double rmsd_without_bias = 0;  ///< Of the differences less the bias.
};

/// @param differences  NaN: not known.
Agreement AgreementOf(std::span<const double> differences);

/// Pearson's correlation of two curves, where both are known; NaN if one does not change.
double CorrelationOf(std::span<const double> a, std::span<const double> b);

/// Coefficient of multiple correlation of two methods' curves of one motion (Ferrari et al. 2010),
/// which offsets between the curves make smaller; NaN where it is not defined.
double MultipleCorrelationOf(std::span<const double> a, std::span<const double> b);

}  // namespace mocap

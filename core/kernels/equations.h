// Sums of normal equations.
#pragma once

#include <array>
#include <cstddef>

namespace mocap::kernels {

/// Force, moment and residual of a contact; the last number is unused.
using WrenchRow = std::array<double, 8>;
/// Products of a row's first six numbers with the row, summed.
using WrenchSum = std::array<WrenchRow, 6>;

struct WrenchTerm {
  WrenchRow row;
  double variance;
  int part;  ///< Index of the sum.
};

/// Adds terms, weighted by their variances, to the sums of their parts.
void AddWrenches(const WrenchTerm* terms, std::size_t count, WrenchSum* sums);

/// Columns are computed in pieces of this many numbers.
inline constexpr int kColumnStep = 8;

/// Adds a row's outer product with itself, times `weight`, to the upper triangle of a matrix. Zeros
/// of the row are skipped.
/// @param stride  numbers from one column to the next. Numbers below the diagonal, up to the next
///                multiple of kColumnStep, are changed too.
void AddSquareAbove(const double* row, int count, double weight, std::ptrdiff_t stride,
                    double* columns);
/// The same for the lower triangle of a matrix of `count` rows, and nothing else.
void AddSquareBelow(const double* row, std::ptrdiff_t count, double weight, double* columns);

}  // namespace mocap::kernels

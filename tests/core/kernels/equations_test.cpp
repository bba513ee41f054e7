#include "core/kernels/equations.h"

#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

TEST(EquationKernels, WrenchesAreAddedOneByOne) {
  Numbers numbers;
  std::vector<WrenchTerm> terms(50);
  for (WrenchTerm& term : terms) {
    std::ranges::copy(numbers.Doubles(8, -100, 100), term.row.begin());
    term.variance = numbers.Doubles(1, 1, 900)[0];
    term.part = numbers.Below(4);
  }
  const auto summed = [&](const auto& add) {
    std::vector<WrenchSum> sums(4, WrenchSum{});
    add(sums.data());
    std::vector<double> all;
    for (const WrenchSum& sum : sums)
      for (const WrenchRow& row : sum) all.insert(all.end(), row.begin(), row.end());
    return all;
  };
  ExpectSameBits(
      [&] {
        return summed([&](WrenchSum* sums) {
          for (const auto& [row, variance, part] : terms)
            for (std::size_t i = 0; i < 6; ++i)
              for (std::size_t k = 0; k < 8; ++k) sums[part][i][k] += row[i] / variance * row[k];
        });
      },
      [&] {
        return summed([&](WrenchSum* sums) { AddWrenches(terms.data(), terms.size(), sums); });
      });
}

TEST(EquationKernels, SquaresAreAddedToTheirTriangles) {
  for (std::size_t count = 1; count < 50; ++count) {
    Numbers numbers(static_cast<std::uint32_t>(count));
    const std::size_t stride = (count + kColumnStep - 1) / kColumnStep * kColumnStep;
    std::vector<double> row = numbers.Doubles(stride, -5, 5);
    for (double& number : row)
      if (numbers.Below(3) == 0) number = 0;
    const std::vector<double> before = numbers.Doubles(stride * stride, -9, 9);
    // Only the upper triangle, column by column.
    const auto above = [&](const auto& add) {
      std::vector<double> columns = before;
      add(columns.data());
      std::vector<double> triangle;
      for (std::size_t j = 0; j < count; ++j)
        triangle.insert(triangle.end(), &columns[j * stride], &columns[j * stride + j + 1]);
      return triangle;
    };
    ExpectSameBits(
        [&] {
          return above([&](double* columns) {
            for (std::size_t j = 0; j < count; ++j)
              for (std::size_t i = 0; i <= j; ++i)
                if (row[j] != 0) columns[j * stride + i] += 0.3 * row[j] * row[i];
          });
        },
        [&] {
          return above([&](double* columns) {
            AddSquareAbove(row.data(), static_cast<int>(count), 0.3,
                           static_cast<std::ptrdiff_t>(stride), columns);
          });
        });
    ExpectSameBits(
        [&] {
          std::vector<double> columns = before;
          for (std::size_t j = 0; j < count; ++j)
            for (std::size_t i = j; i < count; ++i)
              if (row[j] != 0) columns[j * count + i] += 0.3 * row[j] * row[i];
          return columns;
        },
        [&] {
          std::vector<double> columns = before;
          AddSquareBelow(row.data(), static_cast<std::ptrdiff_t>(count), 0.3, columns.data());
          return columns;
        });
  }
}

}  // namespace
}  // namespace mocap::kernels

#include "core/kernels/cells.h"

#include <cmath>

#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

TEST(CellKernels, PointsOfALineAreRoundedDownOneByOne) {
  const BitPitch pitch{5, 300};
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const std::vector<double> some = Numbers(seed).Doubles(6, -20, 90);
    const CellLine line = {{some[0], some[1], some[2]}, {some[3] / 40, some[4] / 40, some[5] / 40}};
    for (const int i : {0, 8, 40}) {
      ExpectSameBits(
          [&] {
            std::vector<int> numbers;
            for (int point = i; point < i + kLinePoints; ++point) {
              std::array<int, 3> cell;
              for (int axis = 0; axis < 3; ++axis)
                cell[axis] = static_cast<int>(std::floor(line.first[axis] - kFirstCell +
                                                         point * line.step[axis])) +
                             kFirstCell;
              numbers.push_back(cell[2] * pitch.layer + cell[1] * pitch.row + (cell[0] >> 6));
              numbers.push_back(cell[0] & 63);
            }
            return numbers;
          },
          [&] {
            LineCells cells;
            FindCells(line, i, pitch, cells);
            std::vector<int> numbers;
            for (std::size_t point = 0; point < kLinePoints; ++point)
              numbers.insert(numbers.end(), {cells.word[point], cells.bit[point]});
            return numbers;
          });
    }
  }
}

}  // namespace
}  // namespace mocap::kernels

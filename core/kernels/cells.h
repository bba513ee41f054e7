// Cells of a grid of bits along a line.
#pragma once

#include <array>

namespace mocap::kernels {

/// This many points of a line are located together.
inline constexpr int kLinePoints = 8;
/// No point lies before this cell.
inline constexpr int kFirstCell = -(1 << 10);

/// A line [cells]: its first point, and the way to the next.
struct CellLine {
  std::array<double, 3> first, step;
};
/// Distances between rows and layers of bits [words].
struct BitPitch {
  int row, layer;
};
/// For each point: its word and the bit in it.
struct LineCells {
  std::array<int, kLinePoints> word, bit;
};

/// Finds the cells of points, from the i-th on; rounds down.
void FindCells(const CellLine& line, int i, const BitPitch& pitch, LineCells& cells);

}  // namespace mocap::kernels

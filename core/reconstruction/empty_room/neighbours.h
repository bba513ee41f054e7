// Pixels beside a pixel.
#pragma once

#include <cstddef>

namespace mocap {

/// Visits the pixels left, right, above and below pixel `i` of a picture, counted row by row.
template <typename Visit>
void ForEachNeighbour(std::size_t i, int width, int height, const Visit& visit) {
  const int x = static_cast<int>(i % width), y = static_cast<int>(i / width);
  if (x > 0) visit(i - 1);
  if (x + 1 < width) visit(i + 1);
  if (y > 0) visit(i - width);
  if (y + 1 < height) visit(i + width);
}

}  // namespace mocap

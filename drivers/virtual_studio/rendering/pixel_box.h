// A part of a picture.
#pragma once

#include <algorithm>

namespace mocap::simulation {

/// Half-open rectangle of pixels.
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  bool empty() const { return x0 >= x1 || y0 >= y1; }
  /// Grows to contain another one.
  void Include(const PixelBox& other) {
    if (other.empty()) return;
    *this = empty() ? other
                    : PixelBox{std::min(x0, other.x0), std::min(y0, other.y0),
                               std::max(x1, other.x1), std::max(y1, other.y1)};
  }
};

}  // namespace mocap::simulation

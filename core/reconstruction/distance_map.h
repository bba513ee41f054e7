// §4: how far a pixel lies from a silhouette's outline, which lets the carver decide whole blocks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/reconstruction/silhouette.h"

namespace mocap {

/// For every pixel the chessboard distance to the nearest pixel of the other kind.
///
/// Positive in the silhouette, negative outside it; never more than the true distance, and capped
/// at kFarthest. Pixels beyond the picture's edge are outside the silhouette.
class DistanceMap {
 public:
  static constexpr int kFarthest = 100;

  /// Measures a silhouette; reuses the memory of the last one.
  void Measure(const Silhouette& silhouette);

  int At(int x, int y) const {
    const int beyond = std::max({left_ - x, x - right_, top_ - y, y - bottom_});
    if (beyond > 0) return -std::min(beyond, kFarthest);
    return cells_[static_cast<std::size_t>(y - top_ + 1) * stride_ + (x - left_ + 1)];
  }

 private:
  // The silhouette's bounding box, inclusive; `cells_` has a margin of one pixel around it.
  int left_ = 0, top_ = 0, right_ = -1, bottom_ = -1;
  int stride_ = 0;
  std::vector<std::int8_t> cells_;
};

}  // namespace mocap

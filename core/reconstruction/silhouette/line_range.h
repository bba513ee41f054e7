// Where a line of sight passes through a box.
#pragma once

#include <algorithm>
#include <optional>

#include "core/geometry.h"

namespace mocap {

/// A part of a line, by the distances from its origin.
struct LineRange {
  double from_mm;
  double to_mm;
};

/// Returns the part of a line, from its origin on, that lies within a box; empty if it misses it.
/// @param direction_W  unit vector.
inline std::optional<LineRange> RangeWithin(const Eigen::AlignedBox3d& box_W,
                                            const Vector3& origin_W, const Vector3& direction_W) {
  if (box_W.isEmpty()) return std::nullopt;
  const Vector3 a = (box_W.min() - origin_W).cwiseQuotient(direction_W);
  const Vector3 b = (box_W.max() - origin_W).cwiseQuotient(direction_W);
  const double from_mm = std::max(0.0, a.cwiseMin(b).maxCoeff());
  const double to_mm = a.cwiseMax(b).minCoeff();
  if (!(from_mm < to_mm)) return std::nullopt;
  return LineRange{from_mm, to_mm};
}

}  // namespace mocap

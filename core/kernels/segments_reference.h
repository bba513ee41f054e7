// What segments.h means, pair by pair.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/kernels/segments.h"

namespace mocap::kernels::reference {

using Vector = std::array<double, 3>;

inline double Dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector Difference(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector GoAlong(const Vector& from, double share, const Vector& way) {
  return {from[0] + share * way[0], from[1] + share * way[1], from[2] + share * way[2]};
}
inline Vector At(const SegmentBatch::Columns& columns, int i) {
  return {columns[0][i], columns[1][i], columns[2][i]};
}
inline double Distance(const Vector& a, const Vector& b) {
  const Vector way = Difference(b, a);
  return std::sqrt(Dot(way, way));
}

/// Closest points of two segments (Ericson 2005, §5.1.9), moved to where a tapered capsule is
/// nearest.
inline void FindSegmentDistance(int i, SegmentBatch& batch) {
  constexpr double kLeast = 1e-9;
  const auto share_of = [](double share) { return std::clamp(share, 0.0, 1.0); };
  const Vector a = At(batch.a, i), core = At(batch.core, i);
  const Vector from = At(batch.from, i), along = At(batch.along, i), between = Difference(a, from);
  const double radius = batch.radius[i], taper = batch.taper[i];
  const double core_sq = std::max(Dot(core, core), kLeast);
  const double along_sq = std::max(Dot(along, along), kLeast);
  const double dot = Dot(core, along), c = Dot(core, between), f = Dot(along, between);
  const double slant = core_sq * along_sq - dot * dot;
  const double first =
      slant > kLeast * core_sq * along_sq ? share_of((dot * f - c * along_sq) / slant) : 0.5;
  const double on_segment = share_of((dot * first + f) / along_sq);
  double share = share_of((dot * on_segment - c) / core_sq);
  Vector place = GoAlong(a, share, core), segment_place = GoAlong(from, on_segment, along);
  double apart = Distance(place, segment_place);
  if (share > 0 && share < 1 && on_segment > 0 && on_segment < 1 && taper != 0) {
    const double curvature = slant / core_sq / std::max(apart, 1.0);
    const double slide = std::clamp(taper * dot / core_sq / curvature, -0.5, 0.5);
    segment_place = GoAlong(from, share_of(on_segment + slide), along);
    share = share_of(Dot(Difference(segment_place, a), core) / core_sq);
    place = GoAlong(a, share, core);
    apart = Distance(place, segment_place);
  }
  for (int axis = 0; axis < 3; ++axis) {
    batch.place[axis][i] = place[axis];
    batch.segment_place[axis][i] = segment_place[axis];
  }
  batch.outside[i] = apart - (radius + share * taper);
  batch.share[i] = share;
}

}  // namespace mocap::kernels::reference

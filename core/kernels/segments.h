// Distances between capsules and line segments.
#pragma once

#include <array>

namespace mocap::kernels {

/// A batch of pairs, in columns.
struct SegmentBatch {
  static constexpr int kPairs = 64;
  /// Results are computed for a multiple of this many pairs.
  static constexpr int kStep = 8;
  using Column = std::array<double, kPairs>;
  using Columns = std::array<Column, 3>;

  alignas(64) Columns a, core, from, along;  ///< One end and the way to the other one, of both.
  Column radius, taper;                      ///< At `a`, and how much it grows to the other end.
  // Results.
  Columns place, segment_place;  ///< Nearest points of the capsule's axis and of the segment.
  Column outside, share;         ///< Distance from the surface; place along the axis, 0 to 1.
};

/// Computes the distances of the first `count` pairs, rounded up to kStep.
void FindSegmentDistances(int count, SegmentBatch& batch);

}  // namespace mocap::kernels

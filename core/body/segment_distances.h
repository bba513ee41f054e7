// Distances between capsules and line segments, many at once.
#pragma once

#include <span>

#include "core/body/body_shape.h"

namespace mocap {

/// A capsule, a segment, and the destination of their distance. All are borrowed.
struct CapsuleAndSegment {
  const PosedCapsule* capsule;
  const Vector3* from_W;
  const Vector3* to_W;
  PosedCapsule::SegmentDistance* distance;
};

/// Computes PosedCapsule::DistanceTo for each pair; the results are equal up to rounding.
void FindDistances(std::span<const CapsuleAndSegment> pairs);

}  // namespace mocap

// How far capsules are from line segments: many at once.
#pragma once

#include <span>

#include "core/body/body_shape.h"

namespace mocap {

/// A capsule, a segment, and where their distance is to be written. All are borrowed.
struct CapsuleAndSegment {
  const PosedCapsule* capsule;
  const Vector3* from_W;
  const Vector3* to_W;
  PosedCapsule::SegmentDistance* distance;
};

/// Finds what PosedCapsule::DistanceTo tells of each, the same numbers up to rounding.
void FindDistances(std::span<const CapsuleAndSegment> pairs);

}  // namespace mocap

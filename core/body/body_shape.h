// §5: the flesh: tapered capsules around the chain, to tell how far a voxel lies from the body's
// surface.
#pragma once

#include <algorithm>
#include <vector>

#include "core/body/body_sizes.h"
#include "core/body/body_table.h"

namespace mocap {

/// A cone with round ends, fixed to a segment.
struct Capsule {
  BodyPart part = BodyPart::kTorso;
  int carrier = -1;               ///< The axis that moves it; -1: the torso.
  Vector3 a_T = Vector3::Zero();  ///< Ends of its core at the reference configuration.
  Vector3 b_T = Vector3::Zero();
  double radius_a_mm = 0;
  double radius_b_mm = 0;
  /// Nothing goes on beyond `b` in the same direction: elbow, fingertips, toes.
  bool ends_at_b = false;
};

/// The capsules of a body at the reference configuration.
/// Builds the flesh around the chain; keeps the memory of `capsules`.
void BuildShape(const BodyTable& table, const BodySizes& sizes,
                const BodyPlaces& reference_points_T, std::vector<Capsule>& capsules);

/// A capsule where a pose puts it.
struct PosedCapsule {
  PosedCapsule(const Vector3& a, const Vector3& b, double radius_a, double radius_b)
      : a_W(a),
        b_W(b),
        radius_a_mm(radius_a),
        radius_b_mm(radius_b),
        middle_W((a + b) / 2),
        reach_mm((b - a).norm() / 2 + std::max(radius_a, radius_b)) {}

  Vector3 a_W;
  Vector3 b_W;
  double radius_a_mm;
  double radius_b_mm;
  Vector3 middle_W;
  double reach_mm;  ///< All of it lies this near to its middle.

  /// The closest place of the core to a point, and how far the point lies outside the surface.
  struct Distance {
    Vector3 core_W;
    double outside_mm;  ///< Negative inside.
    double share;       ///< Along the core: 0 at a, 1 at b.
  };
  Distance DistanceTo(const Vector3& p_WQ) const;

  /// The place of the core that is closest to a line segment.
  struct SegmentDistance {
    Vector3 core_W;
    Vector3 segment_W;  ///< The place of the segment that is closest.
    double outside_mm;  ///< Negative where the segment cuts into the capsule.
    double share;       ///< Along the core: 0 at a, 1 at b.
  };
  SegmentDistance DistanceTo(const Vector3& from_W, const Vector3& to_W) const;
};

}  // namespace mocap

// §5: the body surface: tapered capsules around the chain. They give the distance of a voxel from
// the surface.
#pragma once

#include <algorithm>
#include <vector>

#include "core/body/body_sizes.h"
#include "core/body/body_table.h"

namespace mocap {

/// A cone with round ends, fixed to a segment.
struct Capsule {
  BodyPart part = BodyPart::kTorso;
  int carrier = -1;               ///< Row of the axis that moves it; -1: the torso.
  Vector3 a_T = Vector3::Zero();  ///< End of the core at the reference configuration.
  Vector3 b_T = Vector3::Zero();
  double radius_a_mm = 0;
  double radius_b_mm = 0;
  /// No further capsule continues beyond `b` in this direction: elbow, fingertips, toes.
  bool ends_at_b = false;
};

/// Builds the capsules of a body at the reference configuration, around the chain; reuses the
/// memory of `capsules`.
void BuildShape(const BodyTable& table, const BodySizes& sizes,
                const BodyPlaces& reference_points_T, std::vector<Capsule>& capsules);

/// A capsule in the world, for one pose.
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
  double reach_mm;  ///< Radius of a bounding sphere around middle_W.

  /// The point of the core nearest to a given point, and the signed distance from the surface.
  struct Distance {
    Vector3 core_W;
    double outside_mm;  ///< Negative inside.
    double share;       ///< Position along the core: 0 at a, 1 at b.
  };
  Distance DistanceTo(const Vector3& p_WQ) const;

  /// The point of the core nearest to a line segment.
  struct SegmentDistance {
    Vector3 core_W;
    Vector3 segment_W;  ///< The nearest point of the line segment.
    double outside_mm;  ///< Negative where the segment cuts into the capsule.
    double share;       ///< Position along the core: 0 at a, 1 at b.
  };
  SegmentDistance DistanceTo(const Vector3& from_W, const Vector3& to_W) const;
};

}  // namespace mocap

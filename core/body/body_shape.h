// §5: the body surface: tapered capsules around the chain. They give the distance of a voxel from
// the surface.
#pragma once

#include <algorithm>
#include <array>
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
  double cloth_a_mm = 0;  ///< How far cloth hangs off it at each end.
  double cloth_b_mm = 0;
  /// Whether borders of silhouettes hold its core at a, in the middle and at b.
  std::array<bool, 3> held = {true, true, true};
};

/// Builds the capsules of a body at the reference configuration, around the chain; reuses the
/// memory of `capsules`.
void BuildShape(const BodyTable& table, const BodySizes& sizes,
                const BodyPlaces& reference_points_T, std::vector<Capsule>& capsules);

/// A capsule in the world, for one pose. Its surface is that of the cloth, where there is some.
struct PosedCapsule {
  PosedCapsule(const Vector3& a, const Vector3& b, double radius_a, double radius_b)
      : PosedCapsule(a, b, radius_a, radius_b, 0, 0) {}
  PosedCapsule(const Capsule& capsule, const RigidTransform& X_WT)
      : PosedCapsule(
            X_WT * capsule.a_T, X_WT * capsule.b_T, capsule.radius_a_mm + capsule.cloth_a_mm,
            capsule.radius_b_mm + capsule.cloth_b_mm, capsule.cloth_a_mm, capsule.cloth_b_mm) {}
  PosedCapsule(const Vector3& a, const Vector3& b, double radius_a, double radius_b, double cloth_a,
               double cloth_b)
      : a_W(a),
        b_W(b),
        radius_a_mm(radius_a),
        radius_b_mm(radius_b),
        cloth_a_mm(cloth_a),
        cloth_b_mm(cloth_b),
        middle_W((a + b) / 2),
        reach_mm((b - a).norm() / 2 + std::max(radius_a, radius_b)) {}

  Vector3 a_W;
  Vector3 b_W;
  double radius_a_mm;
  double radius_b_mm;
  double cloth_a_mm;  ///< Included in the radii.
  double cloth_b_mm;
  Vector3 middle_W;
  double reach_mm;  ///< Radius of a bounding sphere around middle_W.

  double ClothAt(double share) const { return cloth_a_mm + share * (cloth_b_mm - cloth_a_mm); }

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

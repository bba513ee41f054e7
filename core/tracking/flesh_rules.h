// Rules for any posed body, besides contacts: bones lie in flesh, and limbs do not intersect other
// parts.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/body/body_shape.h"
#include "core/tracking/contact.h"

namespace mocap {

/// Whether flesh begins higher above the floor than the shins, so that the legs were carved away or
/// are in the air.
/// @param lowest_mm  height at which it begins.
inline bool LacksLegs(double lowest_mm) {
  constexpr double kShinMm = 250;
  return lowest_mm > kShinMm;
}

/// Whether a limb's end can run into a part at all: forearms into trunk, head, thighs and each
/// other, a calf into the other leg.
bool MayOverlap(BodyPart limb, BodyPart other);

/// Evidence farther than this from every part belongs to none: a thing, another person, a shadow.
inline constexpr double kExplainedMm = 60;

/// Points along each core that should lie in flesh, as shares of its length.
inline constexpr std::array<double, 3> kCoreShares = {0.0, 0.5, 1.0};

inline Vector3 CorePlace(const PosedCapsule& capsule, double share) {
  return capsule.a_W + share * (capsule.b_W - capsule.a_W);
}
/// The flesh's, without cloth.
inline double RadiusAt(const PosedCapsule& capsule, double share) {
  return capsule.radius_a_mm + share * (capsule.radius_b_mm - capsule.radius_a_mm) -
         capsule.ClothAt(share);
}

/// Points in columns. After the last there may be some at infinite distance.
class PlaceColumns {
 public:
  /// Copies the positions of the contacts that are not edges.
  void Set(std::span<const Contact> contacts);
  int size() const { return size_; }
  /// The nearest to a point; the first of several. @pre there is one.
  Vector3 NearestTo(const Vector3& p_W) const;

 private:
  int size_ = 0;
  std::array<std::vector<double>, 3> axes_;
};

/// Returns the vector from a point in the void to the nearest of some points on the flesh's
/// surface; empty for a point in flesh.
std::optional<Vector3> WayToFlesh(const VoxelCloud& cloud, const PlaceColumns& surface_W,
                                  const Vector3& p_W);

/// Greater distances of a bone from flesh cost no more: the flesh may have been carved away.
inline constexpr double kMostHollowMm = 100;
/// Weight of the surface's distance from the body, compared with an edge's: hulls are wrong about
/// surfaces.
inline constexpr double kSurfaceWeight = 0.25;
/// Weight of a bone's distance from the flesh, compared with an edge's from the body. A whole hull
/// contains the body, so the bones of a right fit are hardly ever outside: with less weight, a
/// large body with bent limbs would explain the clothes of a small one. A hull with holes says
/// less.
/// @param missing_share  see Evidence::MissingShare.
constexpr double HollowWeight(double missing_share) { return 1 - missing_share; }

/// False if a point on the core of `limb` is too far from `other` to intersect it.
bool CanStickIn(const PosedCapsule& limb, const Vector3& p_W, const PosedCapsule& other);

/// Depth of a point on the core of `limb` inside `other`, beyond what flesh yields [mm].
double OverlapDepth(const PosedCapsule& limb, const PosedCapsule& other,
                    const PosedCapsule::Distance& to_other);

}  // namespace mocap

// What holds for any posed body besides touching the surface: bones lie in flesh, and limbs do not
// run through other parts.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/body/body_shape.h"
#include "core/tracking/contact.h"

namespace mocap {

/// Whether flesh begins higher over the floor than shins do, so that the legs were carved away or
/// are in the air.
/// @param lowest_mm  where it begins.
inline bool LacksLegs(double lowest_mm) {
  constexpr double kShinMm = 250;
  return lowest_mm > kShinMm;
}

/// Whether a limb's end can run into a part at all: forearms into trunk, head, thighs and each
/// other, a calf into the other leg.
bool MayOverlap(BodyPart limb, BodyPart other);

/// Places along each core that should lie in flesh, as shares of its length.
inline constexpr std::array<double, 3> kCoreShares = {0.0, 0.5, 1.0};

inline Vector3 CorePlace(const PosedCapsule& capsule, double share) {
  return capsule.a_W + share * (capsule.b_W - capsule.a_W);
}
inline double RadiusAt(const PosedCapsule& capsule, double share) {
  return capsule.radius_a_mm + share * (capsule.radius_b_mm - capsule.radius_a_mm);
}

/// Places in columns. Behind the last there may be some that are infinitely far away.
class PlaceColumns {
 public:
  /// Takes where those contacts are that are no edges.
  void Set(std::span<const Contact> contacts);
  int size() const { return size_; }
  /// The nearest to a place; the first of several. @pre there is one.
  Vector3 NearestTo(const Vector3& p_W) const;

 private:
  int size_ = 0;
  std::array<std::vector<double>, 3> axes_;
};

/// The way from a place in the void to the nearest of some places on the flesh's surface; empty for
/// a place in flesh.
std::optional<Vector3> WayToFlesh(const VoxelCloud& cloud, const PlaceColumns& surface_W,
                                  const Vector3& p_W);

/// A bone that lies farther from flesh than this is no worse: the flesh may have been carved away.
inline constexpr double kMostHollowMm = 100;

/// False where a place on the core of `limb` is too far from `other` to stick in it.
bool CanStickIn(const PosedCapsule& limb, const Vector3& p_W, const PosedCapsule& other);

/// How deep a place on the core of `limb` sticks in `other`, beyond what flesh gives way [mm].
double OverlapDepth(const PosedCapsule& limb, const PosedCapsule& other,
                    const PosedCapsule::Distance& to_other);

}  // namespace mocap

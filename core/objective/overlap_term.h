// Limbs do not run into other parts.
#pragma once

#include "core/body/posed_body.h"
#include "core/objective/noise.h"

namespace mocap {

/// Whether a limb's end can run into a part at all: forearms into trunk, head, thighs and each
/// other, a calf into the other leg.
bool MayOverlap(BodyPart limb, BodyPart other);

/// Depth of a point on the core of `limb` inside `other`, beyond what flesh yields [mm].
double OverlapDepth(const PosedCapsule& limb, const PosedCapsule& other,
                    const PosedCapsule::Distance& to_other);

/// -log p of limbs in other parts: the residual is the depth of places along a limb's core, beyond
/// what flesh yields.
class OverlapTerm {
 public:
  /// @param limbs    capsules that may run into others.
  /// @param present  capsules that they may run into.
  double At(const PosedBody& posed, CapsuleSet limbs, CapsuleSet present) const;
  void Linearize(const PosedBody& posed, CapsuleSet limbs, CapsuleSet present,
                 Linearisation& sums) const;
};

}  // namespace mocap

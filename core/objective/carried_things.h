// Beyond the paper: flesh that is no body. People wear hats and packs, hold bags and sit on chairs,
// and a hull shows all of that. No part of the body explains it. Without a place for it, arms reach
// into a hat or a wheel.
#pragma once

#include <array>
#include <bitset>
#include <optional>

#include "core/body/body_model.h"
#include "core/evidence/contact.h"

namespace mocap {

enum class Thing {
  kHat,   ///< Around the skull; hair and helmets too.
  kPack,  ///< Behind the trunk; the back of a chair too.
  kSeat,  ///< Around the hips of somebody who sits upright: a chair or a wheelchair.
  kBag    ///< Below a hand that hangs down.
};
inline constexpr int kThingCount = 4;
/// A set of things; a bit for each.
using Things = std::bitset<kThingCount>;
inline constexpr Things kAnyThings{(1 << kThingCount) - 1};

/// Cost of anything that is worn or carried [nats]: it has to explain the evidence better by more
/// than this, because it also explains a part of the noise.
inline constexpr double kThingNats = 6;

/// Evidence of such a thing costs as much as this distance from the body.
inline constexpr double kOfThing_mm = 30;

/// The places where a posed body may have things.
class ThingPlaces {
 public:
  /// @param allowed  the things that the body may have.
  ThingPlaces(const BodyModel& body, const Posture& posture, Things allowed);

  /// The first allowed thing that a contact may belong to; empty if there is none.
  std::optional<Thing> At(const Contact& contact) const;

 private:
  bool IsOnHead(const Contact& contact) const;
  bool IsOnBack(const Contact& contact) const;
  bool IsOfSeat(const Contact& contact) const;
  bool IsOfBag(const Contact& contact) const;
  bool Allows(Thing thing) const { return allowed_[static_cast<std::size_t>(thing)]; }

  Things allowed_;
  RigidTransform X_WT_;
  Vector3 up_W_;       ///< From the neck to the head.
  Vector3 chin_W_;     ///< Hats and hair are above it.
  PosedCapsule head_;  ///< All that is around it.
  PosedCapsule back_;
  double behind_mm_;                  ///< Distance of a pack from the spine.
  double beside_mm_;                  ///< Half the width of a pack.
  std::optional<PosedCapsule> seat_;  ///< Of somebody who sits.
  double seat_top_mm_ = 0;
  std::array<std::optional<PosedCapsule>, 2> bags_;
};

}  // namespace mocap

// Motions with feet that stay in place, or nearly so.
#pragma once

#include <cstdint>
#include <memory>

#include "drivers/virtual_studio/motions/motion.h"

namespace mocap::simulation {

/// Place and heading of a person.
struct Spot {
  Vector2 p_W = Vector2::Zero();
  double yaw = 0;
  Vector3 At(double forward_mm, double left_mm, double z_mm) const;
};

/// A random spot near the middle of the room.
Spot RandomSpot(std::uint64_t seed);

/// Jumps repeatedly, with a swing of the arms.
std::unique_ptr<const Motion> MakeJump(const Anthropometry& body, const Spot& spot,
                                       std::uint64_t seed);
/// Sits down on a stool, stays, and stands up.
std::unique_ptr<const Motion> MakeSit(const Anthropometry& body, const Spot& spot);
/// Sits down on a stool, sits still for a minute, and stands up.
std::unique_ptr<const Motion> MakeRest(const Anthropometry& body, const Spot& spot);
/// Lies down on the back, lies still for a minute, and gets up.
std::unique_ptr<const Motion> MakeLie(const Anthropometry& body, const Spot& spot);
/// Steps up a block and down again, one foot after the other.
std::unique_ptr<const Motion> MakeStep(const Anthropometry& body, const Spot& spot);
/// Stands with slightly raised arms and sways.
std::unique_ptr<const Motion> MakeStand(const Anthropometry& body, const Spot& spot,
                                        std::uint64_t seed);

/// Stands, stretches the arms overhead, holds the hands before the face, and folds them.
std::unique_ptr<const Motion> MakeGesture(const Anthropometry& body, const Spot& spot,
                                          std::uint64_t seed);

}  // namespace mocap::simulation

// Motions whose feet stay where they are, or nearly so.
#pragma once

#include <cstdint>
#include <memory>

#include "drivers/simulation/motion.h"

namespace mocap::simulation {

/// Jumps with a swing of the arms, again and again.
std::unique_ptr<const Motion> MakeJump(const Anthropometry& body, std::uint64_t seed);
/// Sits down on a stool, stays, and stands up.
std::unique_ptr<const Motion> MakeSit(const Anthropometry& body, std::uint64_t seed);
/// Steps up a block and down again, one foot after the other.
std::unique_ptr<const Motion> MakeStep(const Anthropometry& body, std::uint64_t seed);
/// Stands with slightly lifted arms, swaying as people do.
std::unique_ptr<const Motion> MakeStand(const Anthropometry& body, std::uint64_t seed);

}  // namespace mocap::simulation

// What several people do in one studio: their paths, places and times, planned so that nobody walks
// through another.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/simulation/motion.h"

namespace mocap::simulation {

/// More people do not find room.
inline constexpr int kMostSimulatedPeople = 4;

/// What several people can do: all that one can, and to meet.
inline constexpr std::array<std::string_view, 9> kCompanyMotionNames = {
    "walk", "run", "jump", "dance", "sit", "step", "stand", "visit", "meet"};

/// Makes a motion for each of some people. One alone moves as MakeMotion() has it. Of several:
///
/// walk: on paths that cross · run: one after the other · dance: close to each other · sit: the
/// first sits down and stands up, the others walk around him · visit: the first half stay, the
/// others come in through the door one after the other, walk around those and leave · meet: two
/// and two walk up to each other, shake hands and part; a third stands by · jump, step, stand: each
/// in a place of his own.
///
/// @param bodies  1 to kMostSimulatedPeople.
/// @return        as many motions, in their order.
/// @throws SetupError  for another name, and for a motion that takes more people.
std::vector<std::unique_ptr<const Motion>> MakeCompany(std::string_view name,
                                                       std::span<const Anthropometry> bodies,
                                                       std::uint64_t seed);

}  // namespace mocap::simulation

// Motions of several people in one studio. Their paths, places and times are planned so that nobody
// walks through another.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/virtual_studio/motions/motion.h"

namespace mocap::simulation {

/// The room has no space for more people.
inline constexpr int kMostSimulatedPeople = 4;

/// Motions of several people: all motions of one person, meeting, and one in the doorway.
inline constexpr std::array<std::string_view, 14> kCompanyMotionNames = {
    "walk", "run",   "jump",    "dance", "sit",  "rest", "lie",
    "step", "stand", "gesture", "visit", "roll", "meet", "doorway"};

/// Makes a motion for each person. A single person moves as in MakeMotion(). Several people:
///
/// walk: on crossing paths · run, roll: one after the other · dance: close to each other · sit: the
/// first sits down and stands up, the others walk around the stool · rest: so, and the first sits
/// still for a minute · lie: so, but the first lies on the floor · doorway: the first stands half
/// outside, the others walk around · visit: the first half stay, the others come in through the
/// door one after the other, walk around those and leave · meet: pairs walk up to each other, shake
/// hands and part; a third person stands by · jump, step, stand, gesture: each in a separate place.
///
/// @param bodies  1 to kMostSimulatedPeople.
/// @return        one motion per body, in their order.
/// @throws SetupError  for another name, and for a motion that needs more people.
std::vector<std::unique_ptr<const Motion>> MakeCompany(std::string_view name,
                                                       std::span<const Anthropometry> bodies,
                                                       std::uint64_t seed);

}  // namespace mocap::simulation

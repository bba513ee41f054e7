// Which parts of a simulated person's feet stand on the floor.
#pragma once

#include <array>

#include "core/body/body_part.h"
#include "drivers/virtual_studio/people/skeleton.h"

namespace mocap::simulation {

/// A sole stands where it is this low [mm] and this slow [mm/s]. Planted soles are on
/// the floor to a fraction of a millimetre; those that bend or roll leave it within a frame. The
/// speed is that of HuMoR's contacts: 5 mm a frame at 30 Hz (Rempe et al. 2021).
inline constexpr double kContactHeight_mm = 5, kContactSpeed_mm_s = 150;

/// In the order of kContactNames; that of a toe is of the forefoot, from ball to tip.
using FloorContacts = std::array<bool, kContactCount>;

/// Finds which heels and forefeet stand on the floor, z = 0: those with a point on the middle line
/// of the sole that stands. A foot on a block is not on the floor.
/// @param later  the same person's bones, `apart_s` after.
FloorContacts ContactsOf(const Anthropometry& body, const BonePoses& bones, const BonePoses& later,
                         double apart_s);

}  // namespace mocap::simulation

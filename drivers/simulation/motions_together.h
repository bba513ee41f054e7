// Motions that only make sense with others.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "drivers/simulation/motion.h"

namespace mocap::simulation {

/// Where two people meet, and how: each walks up to the other, both shake right hands, turn, walk
/// away, turn, and begin again.
struct Meeting {
  Vector2 p_W = Vector2::Zero();  ///< Under the hands that meet.
  double line_rad = 0;            ///< Where the first of the two looks at the other.
  double hands_mm = 0;            ///< Height of the hands.
  double walk_mm = 0;             ///< How far each walks.
  double speed_mm_s = 0;
  double begin_s = 0;  ///< Both set off.
};

/// Plans a meeting of two people on a line of so many millimetres.
Meeting PlanMeeting(const std::array<Anthropometry, 2>& bodies, const Vector2& p_W, double line_rad,
                    double begin_s);

/// @param second  whether this is the one of the two who comes from the far end of the line.
std::unique_ptr<const Motion> MakeGreeting(const Anthropometry& body, const Meeting& meeting,
                                           bool second);

/// A ring of dancers who face each other and circle.
struct DanceRing {
  int dancers = 2;
  double spacing_mm = 0;  ///< From dancer to dancer.
  std::uint64_t seed = 0;
};

/// Dances as one of a ring, with bent arms.
/// @param place  in the ring, from 0.
std::unique_ptr<const Motion> MakeDanceInRing(const Anthropometry& body, const DanceRing& ring,
                                              int place);

}  // namespace mocap::simulation

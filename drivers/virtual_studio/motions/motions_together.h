// Motions of people who interact.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "drivers/virtual_studio/motions/motion.h"

namespace mocap::simulation {

/// Plan of a meeting: both walk up to each other, shake right hands, turn, walk away, turn, and
/// start again.
struct Meeting {
  Vector2 p_W = Vector2::Zero();  ///< Under the clasped hands.
  double line_rad = 0;            ///< Direction in which the first person faces the second.
  double hands_mm = 0;            ///< Height of the hands.
  double walk_mm = 0;             ///< Distance that each walks.
  double speed_mm_s = 0;
  double begin_s = 0;  ///< Both start.
};

/// Plans a meeting of two people on a line.
Meeting PlanMeeting(const std::array<Anthropometry, 2>& bodies, const Vector2& p_W, double line_rad,
                    double begin_s);

/// @param second  whether this person comes from the far end of the line.
std::unique_ptr<const Motion> MakeGreeting(const Anthropometry& body, const Meeting& meeting,
                                           bool second);

/// A circling ring of dancers who face each other.
struct DanceRing {
  int dancers = 2;
  double spacing_mm = 0;  ///< Distance between neighbours.
  std::uint64_t seed = 0;
};

/// Makes the dance of one member of a ring, with bent arms.
/// @param place  in the ring, from 0.
std::unique_ptr<const Motion> MakeDanceInRing(const Anthropometry& body, const DanceRing& ring,
                                              int place);

}  // namespace mocap::simulation

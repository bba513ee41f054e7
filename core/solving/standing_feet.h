// Where a person's feet stand in a part of a take.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/foot_contacts.h"

namespace mocap {

/// Heels and toes in a set.
struct Standing {
  Contacts contacts = kUnknownContacts;
  /// Where those that touch the floor stand.
  std::array<std::optional<Vector3>, kContactCount> places_W;
};

/// Tells the contacts of successive poses by the motion of the feet before and after each, so that
/// they begin and end neither early nor late. A heel or toe that touches the floor stands at the
/// mean of its places; one that slides farther than a few centimetres stands anew.
/// @param dt_s  time since the set before; as many as poses.
/// @return  one for each; unknown for a body whose feet do not turn.
std::vector<Standing> StandingFeetOf(const BodyModel& body, std::span<const PoseState> poses,
                                     std::span<const double> dt_s);

}  // namespace mocap

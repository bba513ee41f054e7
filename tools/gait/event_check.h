// Events of gait found in two ways: by contact and by position.
#pragma once

#include <array>
#include <span>

#include "tools/kinematics/gait_events.h"

namespace mocap {

/// How events by position agree with those of the same side and kind by contact.
struct EventAgreement {
  int by_contact = 0, by_position = 0;
  int both = 0;                     ///< Less than kSameEvent_s apart.
  double mean_s = 0, spread_s = 0;  ///< How much later those by position are.
};

/// By GaitEventKind.
using EventCheck = std::array<EventAgreement, kGaitEventNames.size()>;

/// Half the shortest time between two events of a kind and side, a runner's stride of 0.5 s.
inline constexpr double kSameEvent_s = 0.25;

/// @param by_contact, by_position  in order of time.
EventCheck CompareEvents(std::span<const GaitEvent> by_contact,
                         std::span<const GaitEvent> by_position);

}  // namespace mocap

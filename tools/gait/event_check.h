// Events of gait found in two ways: by contact and by position.
#pragma once

#include <array>
#include <span>

#include "tools/gait/mean_and_spread.h"
#include "tools/kinematics/gait_events.h"

namespace mocap {

/// How events by position agree with those of the same side and kind by contact.
struct EventAgreement {
  int by_contact = 0, by_position = 0;
  MeanAndSpread later_s;  ///< How much later those by position are that are near one by contact.
};

/// By GaitEventKind.
using EventCheck = std::array<EventAgreement, kGaitEventNames.size()>;

/// Events less than this apart are the same: half of a runner's stride of 0.5 s.
inline constexpr double kSameEvent_s = 0.25;

/// @param by_contact, by_position  in order of time.
EventCheck CompareEvents(std::span<const GaitEvent> by_contact,
                         std::span<const GaitEvent> by_position);

}  // namespace mocap

// §6.2: finds a limb again that has been lost, by what it should explain and not by its distance
// from the prediction.
#pragma once

#include <optional>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/stance.h"
#include "core/tracking/contact.h"
#include "core/tracking/evidence.h"

namespace mocap {

/// Tries each arm and leg in many stances when outlines are left that no part explains. Only what
/// the rest of the body does not explain is matched, so that a stance costs microseconds. Keeps its
/// memory.
class LimbRecovery {
 public:
  LimbRecovery();

  /// Looks for a pose that explains clearly more of the evidence than `pose` does, changing the
  /// limbs alone.
  std::optional<PoseState> Recover(const BodyModel& body, const Evidence& evidence,
                                   const PoseState& pose);

 private:
  std::vector<Stance> arm_stances_;
  std::vector<Stance> leg_stances_;
  std::vector<Contact> contacts_;
  std::vector<PosedCapsule> posed_;
};

}  // namespace mocap

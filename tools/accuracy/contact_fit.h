// The odds of contacts with the floor by the motion of feet, fitted at tracked poses of simulated
// people.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/body/foot_contacts.h"

namespace mocap {

/// One heel, or the toes of one foot, in one frame set.
struct ContactSample {
  FootMotion motion;
  bool touches = false;  ///< In truth.
};

/// What one take shows, by heels and toes.
struct ContactTake {
  std::vector<ContactSample> heels, toes;
};

/// Fits the odds by maximum likelihood (logistic regression).
ContactOdds FitContactOdds(std::span<const ContactSample> samples);

/// A table of both parts: the takes at even places are fitted, the others check.
std::string ContactTable(std::span<const ContactTake> takes);

}  // namespace mocap

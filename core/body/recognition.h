// Beyond the paper: recognises people by the sizes of their bodies.
#pragma once

#include <span>
#include <string>

#include "core/body/body_sizes.h"

namespace mocap {

/// A person whose sizes were stored.
struct KnownPerson {
  std::string name;
  BodySizes sizes;
};

/// The most likely person for a measured body.
struct Likeness {
  const KnownPerson* person = nullptr;  ///< Null: more likely none of the known people.
  double certainty = 0;                 ///< Probability of this result, 0 to 1.
};

/// From this certainty on a person gets a name.
inline constexpr double kSureOfName = 0.9;

/// Compares the known people with each other and with strangers, by Bayes' rule.
///
/// Repeated measurements of one person differ little; sizes of two people differ as in a population
/// (ANSUR, Gordon et al. 1989). Only stature and torso are used: limbs are measured less exactly,
/// and widths change with the clothes.
/// @param measured  sizes that have settled.
/// @param known     people who may be there: not those who are present already. Borrowed.
Likeness WhoIs(const BodySizes& measured, std::span<const KnownPerson> known);

}  // namespace mocap

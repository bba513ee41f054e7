// Beyond the paper: who somebody is, by the sizes of his body.
#pragma once

#include <span>
#include <string>

#include "core/body/body_sizes.h"

namespace mocap {

/// Somebody whose sizes were kept.
struct KnownPerson {
  std::string name;
  BodySizes sizes;
};

/// Who a measured body most likely is.
struct Likeness {
  const KnownPerson* person = nullptr;  ///< Null: rather nobody who is known.
  double certainty = 0;                 ///< Probability that it is so, 0 to 1.
};

/// From here on somebody is called by a name; below, there is doubt.
inline constexpr double kSureOfName = 0.9;

/// Weighs the people who are known against each other and against anybody else, by Bayes' rule.
///
/// Sizes of one person that are measured twice differ little, those of two people as they differ in
/// a population (ANSUR, Gordon et al. 1989).
/// Stature and torso count: limbs are measured less exactly, and widths change with the clothes.
/// @param measured  sizes that have settled.
/// @param known     who may be there: not those who are there already. Borrowed.
Likeness WhoIs(const BodySizes& measured, std::span<const KnownPerson> known);

}  // namespace mocap

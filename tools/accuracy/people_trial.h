// One simulated take of several people, tracked as `mocap track --people` does, beside its truth.
#pragma once

#include <cstdint>
#include <string>

#include "core/evaluation/people_accuracy.h"
#include "drivers/simulation/simulated_studio.h"

namespace mocap {

/// How well everybody of a take was followed, in seconds where PeopleAccuracy has sets.
struct PeopleRow {
  std::string motion;
  int people = 0;
  std::uint64_t seed = 0;
  double mpjpe_mm = 0, worst_person_mm = 0;
  double found_share = 0;      ///< Of the covered sets of all: followed by anybody.
  double slowest_found_s = 0;  ///< Covered, until first followed; of whom it took longest.
  double longest_lost_s = 0;
  int switches = 0;
  double phantom_s = 0;  ///< Phantoms and duplicates.
  int never_found = 0;   ///< People who were covered and never followed.
};

/// Sums up what was measured.
/// @param studio  the simulated one; its fps are the sets a second.
PeopleRow SumUp(const SimulatedStudioOptions& studio, const PeopleAccuracy& accuracy);

/// Simulates a take and tracks it; as many may be followed as the simulated studio can hold. The
/// same options have the same outcome.
/// @throws SetupError  when the studio cannot be as it is asked for.
PeopleRow RunPeopleTrial(const SimulatedStudioOptions& studio);

}  // namespace mocap

// One simulated take of several people, tracked as by `mocap track --people` and compared with
// truth.
#pragma once

#include <cstdint>
#include <string>

#include "core/evaluation/people_accuracy.h"
#include "drivers/virtual_studio/studio_options.h"

namespace mocap {

/// Tracking quality over all people of a take; in seconds, where PeopleAccuracy counts frame sets.
struct PeopleRow {
  std::string motion;
  int people = 0;
  std::uint64_t seed = 0;
  double mpjpe_mm = 0, worst_person_mm = 0;
  double found_share = 0;      ///< Share of covered sets, over all people, in which they are
                               ///< tracked.
  double slowest_found_s = 0;  ///< Covered time before a person is first tracked; maximum.
  double longest_lost_s = 0;
  int switches = 0;
  double phantom_s = 0;  ///< Phantoms and duplicates.
  int never_found = 0;   ///< People who were covered but never tracked.
};

/// Summarizes the measurements.
/// @param studio  the simulated one; its fps are the frame sets per second.
PeopleRow SumUp(const SimulatedStudioOptions& studio, const PeopleAccuracy& accuracy);

/// Simulates a take and tracks it, with as many people as the simulated studio can hold. The same
/// options give the same outcome.
/// @throws SetupError  for invalid studio options.
PeopleRow RunPeopleTrial(const SimulatedStudioOptions& studio);

}  // namespace mocap

// True motion and sizes of the people of a simulated studio.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "drivers/take/take_writer.h"
#include "drivers/take/truth_columns.h"
#include "drivers/virtual_studio/people/floor_contact.h"
#include "drivers/virtual_studio/people/skeleton.h"
#include "drivers/virtual_studio/studio_options.h"

namespace mocap {

/// p_WQ of the points named by kSimulatedJointNames [mm].
using JointPositions = simulation::TruePoints;
inline constexpr auto& kSimulatedJointNames = simulation::kTruthPointNames;

/// R_WB of kTurnedSegmentNames. A segment's axes are x forward, y to the left and z up while the
/// person stands upright with hanging arms.
using SegmentRotations = std::array<Matrix3, kTurnedSegmentNames.size()>;

namespace simulation {
class Person;
}

/// What is true of the simulated people, numbered from 0. Reentrant.
class SimulatedTruth {
 public:
  /// @throws SetupError  for invalid options.
  explicit SimulatedTruth(const SimulatedStudioOptions& options);
  ~SimulatedTruth();
  SimulatedTruth(SimulatedTruth&&) noexcept;

  JointPositions At(std::int64_t capture_ns, int person = 0) const;
  simulation::FloorContacts ContactsAt(std::int64_t capture_ns, int person = 0) const;
  SegmentRotations RotationsAt(std::int64_t capture_ns, int person = 0) const;
  TruthSizes Sizes(int person = 0) const;

 private:
  std::vector<simulation::Person> people_;
};

}  // namespace mocap

// A tracked person, as the service reports it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/body/body_sizes.h"
#include "core/geometry.h"
#include "core/motion_capture.h"

namespace mocap {

struct FollowedPerson {
  int id = 0;             ///< As on MOCAP_PEOPLE.
  std::string name = {};  ///< Empty: unknown.
  double certainty = 1;   ///< That the name is right, 0 to 1; 1 if it was given.
  CaptureState state = CaptureState::kSearching;
  Vector3 torso_W = Vector3::Zero();  ///< [mm]
  double residual_mm = 0;             ///< Meaningful while tracking.
  BodySizes sizes = {};
  std::int64_t since_ns = 0;  ///< First seen, by the steady clock.
};

/// Those who are being tracked.
std::vector<FollowedPerson> Tracked(std::vector<FollowedPerson> people);
/// The person with this number, or the only one.
/// @throws SetupError  if nobody has the number, or none is given and there are several; it lists
/// them.
/// @pre  `people` is not empty.
const FollowedPerson& ChoosePerson(std::span<const FollowedPerson> people, std::optional<int> id);

/// "person 2", "person 2 (anna)".
std::string LabelOf(int id, const std::string& name);
/// "person 1, person 2 (anna)".
std::string LabelsOf(std::span<const FollowedPerson> people);

}  // namespace mocap

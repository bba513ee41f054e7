// Somebody who is followed, as the service tells of him.
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
  std::string name = {};  ///< Empty: not known.
  double certainty = 1;   ///< That the name is his, 0 to 1; 1 where somebody told.
  CaptureState state = CaptureState::kSearching;
  Vector3 torso_W = Vector3::Zero();  ///< [mm]
  double residual_mm = 0;             ///< Meaningful while tracking.
  BodySizes sizes = {};
  std::int64_t since_ns = 0;  ///< When he was first there, by the steady clock.
};

/// Those who are tracked.
std::vector<FollowedPerson> Tracked(std::vector<FollowedPerson> people);
/// The one who is meant: by number, or the only one.
/// @throws SetupError  when nobody has the number, or none is told of several; it lists who is
/// there.
/// @pre  somebody is there.
const FollowedPerson& ChoosePerson(std::span<const FollowedPerson> people, std::optional<int> id);

/// "person 2", "person 2 (anna)".
std::string LabelOf(int id, const std::string& name);
/// "person 1, person 2 (anna)".
std::string LabelsOf(std::span<const FollowedPerson> people);

}  // namespace mocap

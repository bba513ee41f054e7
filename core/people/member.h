// Beyond the paper: what is known of one of several people.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/motion_capture.h"
#include "core/people/flesh_division.h"
#include "core/people/outline_division.h"
#include "core/people/side_search.h"

namespace mocap {

/// Reach of somebody who was tracked in the last set, but for the way since.
inline constexpr double kReachMm = 220;

/// Somebody who is tracked or searched for.
struct Member {
  bool has_pose() const { return !beside && capture->result().state != CaptureState::kSearching; }
  bool is_lost() const { return has_pose() && capture->result().state == CaptureState::kLost; }
  void SetName(std::string_view to, double how_certain) {
    name = to;
    certainty = how_certain;
  }

  std::shared_ptr<MotionCapture> capture;
  /// While set, the capture works there and must not be used.
  std::unique_ptr<SideSearch> beside;
  int id = 0;                ///< 0: not yet confirmed as a person.
  std::string name;          ///< Empty: unknown.
  double certainty = 1;      ///< Of the name.
  BodySizes compared;        ///< Sizes that were last compared with known people.
  bool is_expected = false;  ///< The next person has that name.
  /// Centre of the flesh of a person who is not located yet.
  std::optional<Vector3> last_W;
  /// Flesh this close to the predicted body may be the person's. Grows while the person is not
  /// tracked.
  double reach_mm = kReachMm;
  // The following times are of PeopleCapture's clock.
  std::optional<std::int64_t> waits_since_ns;  ///< For the search.
  /// Entered from outside the covered area, or when nobody else was tracked yet.
  bool has_come = false;
  std::int64_t seen_ns = 0;
  std::int64_t vouched_ns = 0;  ///< Last time with enough witnesses.
  /// What this frame shows; null without flesh.
  const FleshShare* flesh = nullptr;
  const OutlineShare* outlines = nullptr;
  Eigen::AlignedBox3d box_W;  ///< Contains the person.
};

}  // namespace mocap

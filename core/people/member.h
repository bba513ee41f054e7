// Beyond the paper: what is known of one of several people.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/evidence/keypoint_rays.h"
#include "core/motion_capture.h"
#include "core/people/flesh_division.h"
#include "core/people/outline_division.h"
#include "core/side_search.h"

namespace mocap {

/// Somebody who is tracked or searched for. Times are of PeopleCapture's clock [s].
struct Member {
  bool has_pose() const { return !beside && capture->result().state != CaptureState::kSearching; }
  bool is_lost() const { return !beside && capture->result().state == CaptureState::kLost; }
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
  std::optional<double> waits_since_s;  ///< For the search.
  /// Entered from outside the covered area, or when nobody else was tracked yet.
  bool has_come = false;
  double seen_s = 0;      ///< Last time that enough cameras showed the person.
  double strayed_mm = 0;  ///< How far the person may have gone since they were tracked.
  /// What this frame shows; null without flesh.
  const FleshShare* flesh = nullptr;
  const OutlineShare* outlines = nullptr;
  std::span<const KeypointRays> keypoints = {};
  Eigen::AlignedBox3d box_W;  ///< Contains the person.
};

}  // namespace mocap

// Whether people are before the cameras, and whether the cameras agree where.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/calibration/finding.h"
#include "core/calibration/seen_shape.h"

namespace mocap {

/// What the silhouettes of the last seconds show, whatever is tracked.
struct SeenPeople {
  /// How long most cameras have shown something of a person's size that moves: at least
  /// PeopleWatch::kWindow_ns, or 0 for nobody.
  std::int64_t seen_for_ns = 0;
  /// Why it cannot be tracked; empty if nothing speaks against it.
  std::optional<Finding> fault = {};

  bool is_somebody() const { return seen_for_ns > 0; }
};

/// Looks at moments of some seconds. Not thread-safe.
class PeopleWatch {
 public:
  static constexpr std::int64_t kWindow_ns = 5'000'000'000;

  explicit PeopleWatch(std::vector<CameraCalibration> cameras) : cameras_(std::move(cameras)) {}

  /// @return  what is seen from this moment on.
  SeenPeople Add(std::int64_t capture_ns, SeenMoment moment);

 private:
  const std::vector<CameraCalibration> cameras_;
  std::vector<SeenMoment> moments_;  ///< The latest of the present episode; empty: nobody is seen.
  std::int64_t begin_ns_ = 0, last_ns_ = 0;  ///< Of that episode.
};

}  // namespace mocap

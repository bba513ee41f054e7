// Beyond the paper: a body that does not move is not made to tremble by noise, and feet that stand
// do not slide.
#pragma once

#include <array>
#include <optional>

#include "core/body/body_model.h"
#include "core/hypotheses/pose_filter.h"
#include "core/motion_capture.h"

namespace mocap {

/// Steadies the poses of a filter, which follows fast motions and therefore the noise of each
/// frame.
///
/// Each point of the body is measured once more, where it was in the frame before. The variance
/// grows quickly with the distance (Geman and McClure 1987): noise is held back, and a motion that
/// is larger than noise breaks free in the frame in which it begins. The filter's covariance tells
/// how the parts of the body depend on each other, and how large the noise is. A low-pass filter of
/// the output would delay motions, and so would a filter with less process noise.
///
/// A heel or toe that touches the floor is pulled to the mean of its places since touchdown, over
/// at most the last half second.
class SteadyPose {
 public:
  /// Forgets the frame before.
  void Reset();

  /// Returns the pose of a frame.
  /// @param std_mm  standard deviations of the body's points, as published.
  /// @param contacts  of the feet.
  /// @param dt_s    since the frame before.
  const PoseState& Follow(const BodyModel& body, const PoseFilter& filter, const PointStds& std_mm,
                          const Contacts& contacts, double dt_s);

 private:
  PoseState Steady(const BodyModel& body, const PoseFilter& filter, const PointStds& std_mm,
                   double dt_s) const;

  /// A point that touches the floor.
  struct Stand {
    Vector3 place_W;
    double lasts_s = 0;
  };
  void FollowStands(const BodyModel& body, const PoseState& pose, const Contacts& contacts,
                    double dt_s);

  std::optional<PoseState> held_;
  std::array<std::optional<Stand>, kContactCount> stands_;
};

}  // namespace mocap

// Planes through two lenses that touch a person.
#pragma once

#include <array>
#include <vector>

#include "tools/import/silhouette_hull.h"

namespace mocap {

/// Angles of the two planes through the lenses of a pair of cameras that touch the silhouette of
/// one of them, over time. At the same moment both cameras have the same angles, because such a
/// plane touches the person at one point that both see (a frontier point: Sinha and Pollefeys 2004,
/// "Synchronization and calibration of camera networks from silhouettes").
struct TangentTrack {
  /// The lower and the upper plane.
  struct Touch {
    std::array<float, 2> angle_rad;  ///< NaN: not seen.
    std::array<float, 2> pixel_rad;  ///< By how much the angle changes with a pixel.
  };
  std::vector<double> times_s;
  std::vector<Touch> touches;
};

/// The tracks of both cameras of a pair.
struct TangentPair {
  TangentTrack first, second;
};
TangentPair TangentsOf(const CameraHulls& first, const CameraHulls& second);

/// A track at equal intervals, from its first time on.
struct SampledTrack {
  double begin_s = 0, step_s = 0;
  std::vector<TangentTrack::Touch> touches;
};
/// Interpolates linearly between frames, not over gaps.
SampledTrack Sample(const TangentTrack& track, double step_s);

/// The track between its frames. @param at  counts from a frame to a later one as time goes by, so
/// that successive calls are fast; begins with 0.
TangentTrack::Touch TouchAt(const TangentTrack& track, double time_s, std::size_t& at);

}  // namespace mocap

// What becomes of one camera's picture: no pixels.
#pragma once

#include <cstdint>

#include "core/reconstruction/silhouette/outline.h"
#include "core/reconstruction/silhouette/shading.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Most rays of an outline that one person needs; of several, outlines have more.
inline constexpr int kRaysPerPerson = 100;
inline constexpr int kMostRays = 2 * kRaysPerPerson;

/// Silhouette and outline of one picture.
struct SegmentedFrame {
  Silhouette silhouette;
  Outline outline;       ///< The silhouette's border.
  Shading shading;       ///< What the picture tells of shadows.
  PanTiltAngles angles;  ///< Of the camera's head.
  RigidTransform X_CW;   ///< Where the camera stood.
  std::int64_t capture_ns = 0;
  std::uint64_t sequence = 0;
  std::int64_t arrival_ns = 0;  ///< When the driver handed it out, on the timeline.
  std::int64_t segment_ns = 0;  ///< How long segmentation took.
  /// Most of the picture is unlike the empty studio, or the camera looks elsewhere: whoever stands
  /// there is not to be seen, or not where calibration has him.
  bool is_blind = false;
  double light = 1;      ///< Brightness, over that of the empty studio as learned.
  double nudged_px = 0;  ///< How far the picture lies from where it was learned.
};

}  // namespace mocap

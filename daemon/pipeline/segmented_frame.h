// The result of segmenting one camera's picture, without pixels.
#pragma once

#include <cstdint>

#include "core/reconstruction/silhouette/outline.h"
#include "core/reconstruction/silhouette/shading.h"
#include "core/reconstruction/silhouette/trimap.h"

namespace mocap {

/// Maximum number of rays for one person's outline. With several people, outlines have more.
inline constexpr int kRaysPerPerson = 100;
inline constexpr int kMostRays = 2 * kRaysPerPerson;
/// Rays of an outline where up to this many people are tracked, as a multiple of one person's.
constexpr int FinenessFor(int people) { return people > 1 ? kMostRays / kRaysPerPerson : 1; }

/// Trimap and outline of one picture.
struct SegmentedFrame {
  Trimap trimap;
  Outline outline;       ///< The person's border.
  Shading shading;       ///< Information about shadows.
  PanTiltAngles angles;  ///< Of the pan-tilt head.
  RigidTransform X_CW;   ///< The camera's pose.
  std::int64_t capture_ns = 0;
  std::uint64_t sequence = 0;
  std::int64_t arrival_ns = 0;  ///< When the driver delivered it, on the timeline.
  std::int64_t segment_ns = 0;  ///< Duration of segmentation.
  /// More than a third of the picture differs from the background, or the camera looks elsewhere. A
  /// person is then not visible, or not where calibration puts them.
  bool is_blind = false;
  double light = 1;      ///< Brightness relative to the learned background.
  double nudged_px = 0;  ///< Shift of the picture relative to the learned background.
};

}  // namespace mocap

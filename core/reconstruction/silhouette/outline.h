// §4, beyond the paper: the silhouette's border as rays. A hull is larger than the person and
// contains ghosts. A ray through the border touches the person itself.
#pragma once

#include <vector>

#include "core/kernels/spread_choice.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/trimap.h"

namespace mocap {

/// A line of sight that touches the person's surface at some depth without entering it.
struct GrazingRay {
  Vector3 eye_W;
  Vector3 direction_W;  ///< Unit length, away from the camera.
  Vector3 outward_W;    ///< The surface's normal where the ray touches it; unit length.
  SpreadRank rank = 0;  ///< Of the border's pixel.
  double after_s = 0;   ///< When its picture was taken, after the time of the set.

  /// Whether the border has no direction there, or the lens does not cover the position.
  bool empty() const { return outward_W == Vector3::Zero(); }
};

/// The person's border in one camera.
using Outline = std::vector<GrazingRay>;

/// Traces a person's border, holes included, by evenly spread rays. A part of the border that stays
/// keeps its rays. At the picture's edge, and beside unknown pixels, the border is not the person's
/// and gives no rays.
/// Empty rays are kept, so that ThinOutline yields the trace with fewer rays.
/// @param most  limit for the number of rays.
/// @param outline  overwritten; its memory is reused.
void TraceOutline(const CameraCalibration& camera, const RigidTransform& X_CW, const Trimap& trimap,
                  int most, Outline& outline);

/// Copies the `step`-th part of the rays, evenly spread, without empty ones; reuses the memory of
/// `thin`.
void ThinOutline(const Outline& dense, int step, Outline& thin);

}  // namespace mocap

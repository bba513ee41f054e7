// §4, beyond the paper: the silhouette's border as rays. A hull is larger than the person and
// contains ghosts. A ray through the border touches the person itself.
#pragma once

#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// A line of sight that touches the person's surface at some depth without entering it.
struct GrazingRay {
  Vector3 eye_W;
  Vector3 direction_W;  ///< Unit length, away from the camera.
  Vector3 outward_W;    ///< The surface's normal where the ray touches it; unit length.

  /// Whether the border has no direction there, or the lens does not cover the position.
  bool empty() const { return outward_W == Vector3::Zero(); }
};

/// The person's border in one camera.
using Outline = std::vector<GrazingRay>;

/// Traces a silhouette's border, holes included, by evenly spread rays. At the picture's edge the
/// border is not the person's and gives no rays. Empty rays are kept, so that every n-th ray equals
/// a trace with n times fewer rays.
/// @param most  limit for the number of rays.
/// @param outline  overwritten; its memory is reused.
void TraceOutline(const CameraCalibration& camera, const RigidTransform& X_CW,
                  const Silhouette& silhouette, int most, Outline& outline);

/// Copies every `step`-th ray that is not empty; reuses the memory of `thin`.
void ThinOutline(const Outline& dense, int step, Outline& thin);

}  // namespace mocap

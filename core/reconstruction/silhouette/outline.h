// §4, beyond the paper: the silhouette's border as rays. A hull is fatter than the person and holds
// flesh that nobody has; a ray through the border grazes the person itself.
#pragma once

#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// A line of sight that touches the person's surface at some depth and enters it nowhere.
struct GrazingRay {
  Vector3 eye_W;
  Vector3 direction_W;  ///< Unit length, away from the camera.
  Vector3 outward_W;    ///< The surface's normal where the ray touches it; unit length.

  /// The border has no direction there, or the lens does not tell of the place.
  bool empty() const { return outward_W == Vector3::Zero(); }
};

/// The person's border as one camera saw it.
using Outline = std::vector<GrazingRay>;

/// Traces a silhouette's border, holes included, by rays spread evenly over it. Where the picture
/// ends, the border is the picture's and not the person's: it gives no rays. Empty rays are kept,
/// so that every n-th ray is one of those that n times fewer would be.
/// @param most  rays at the most.
/// @param outline  overwritten; its memory is reused.
void TraceOutline(const CameraCalibration& camera, const RigidTransform& X_CW,
                  const Silhouette& silhouette, int most, Outline& outline);

/// Takes every `step`-th ray but for empty ones; reuses the memory of `thin`.
void ThinOutline(const Outline& dense, int step, Outline& thin);

}  // namespace mocap

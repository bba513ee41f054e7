#include "core/evidence/keypoint_rays.h"

namespace mocap {

KeypointRays CastKeypoints(const KeypointView& view, int camera, const Lens& lens,
                           const RigidTransform& X_CW, std::int64_t set_ns) {
  KeypointRays seen;
  seen.camera = camera;
  seen.after_s = static_cast<double>(view.capture_ns - set_ns) * 1e-9;
  const RigidTransform X_WC = X_CW.Inverse();
  for (const Keypoint& point : view.points) {
    const auto plane = NormalizedFromPixel(lens, point.px.cast<double>());
    if (!plane) continue;
    const Vector3 towards_C(plane->x(), plane->y(), 1);
    seen.rays.push_back({point.landmark, point.score, X_WC.p, (X_WC.R * towards_C).normalized()});
  }
  return seen;
}

}  // namespace mocap

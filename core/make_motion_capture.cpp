#include "core/make_motion_capture.h"

#include "core/surface_capture.h"

namespace mocap {

std::unique_ptr<MotionCapture> MakeMotionCapture(TrackerKind, const BodyTable& table) {
  return std::make_unique<SurfaceCapture>(table);
}

}  // namespace mocap

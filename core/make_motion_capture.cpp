#include "core/make_motion_capture.h"

#include "core/errors.h"
#include "core/mikic2003/mikic_capture.h"
#include "core/surface_capture.h"

namespace mocap {

void RequireBodyOf(TrackerKind kind, const BodyTable& table) {
  if (kind == TrackerKind::kMikic2003) mikic2003::RequirePaperAxes(table);
}

std::unique_ptr<MotionCapture> MakeMotionCapture(TrackerKind kind, const BodyTable& table) {
  RequireBodyOf(kind, table);
  switch (kind) {
    case TrackerKind::kSurface:
      return MakeSurfaceCapture(table);
    case TrackerKind::kMikic2003:
      return std::make_unique<mikic2003::MikicCapture>(table);
  }
  MOCAP_CHECK(false);
}

}  // namespace mocap

// The trackers that there are.
#pragma once

#include <memory>

#include "core/motion_capture.h"

namespace mocap {

/// Which tracker follows the person.
enum class TrackerKind {
  kSurface,  ///< Beyond the paper: the surface of the flesh and the silhouettes' outlines.
};

/// Makes a tracker for a body.
std::unique_ptr<MotionCapture> MakeMotionCapture(TrackerKind kind, const BodyTable& table);

}  // namespace mocap

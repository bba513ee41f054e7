// The trackers that there are.
#pragma once

#include <memory>

#include "core/motion_capture.h"

namespace mocap {

/// Which tracker follows the person.
enum class TrackerKind {
  kSurface,    ///< Beyond the paper: the surface of the flesh and the silhouettes' outlines.
  kMikic2003,  ///< The paper's §6 and §7 as published.
};

/// Checks that a tracker can follow a body. @throws SetupError
void RequireBodyOf(TrackerKind kind, const BodyTable& table);

/// Makes a tracker for a body. @throws SetupError  when the tracker wants another one.
std::unique_ptr<MotionCapture> MakeMotionCapture(TrackerKind kind, const BodyTable& table);

}  // namespace mocap

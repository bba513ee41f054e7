// The available trackers.
#pragma once

#include <memory>

#include "core/motion_capture.h"

namespace mocap {

/// Selects the tracker of a person.
enum class TrackerKind {
  kSurface,    ///< Beyond the paper: the surface of the flesh and the silhouettes' outlines.
  kMikic2003,  ///< The paper's §6 and §7 as published.
};

/// Checks that a tracker supports a body. @throws SetupError
void RequireBodyOf(TrackerKind kind, const BodyTable& table);

/// Creates a tracker for a body. @throws SetupError  if the tracker does not support it.
std::unique_ptr<MotionCapture> MakeMotionCapture(TrackerKind kind, const BodyTable& table);

}  // namespace mocap

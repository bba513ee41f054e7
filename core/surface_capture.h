// Beyond the paper: tracks a person by the surface of the flesh and the silhouettes' outlines.
#pragma once

#include <memory>

#include "core/motion_capture.h"

namespace mocap {

/// Creates the default tracker. It acquires a body, fits it to the surface in every frame, loses it
/// and acquires it again.
std::unique_ptr<MotionCapture> MakeSurfaceCapture(const BodyTable& table);

}  // namespace mocap

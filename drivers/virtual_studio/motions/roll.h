// Rolling along in a wheelchair.
#pragma once

#include <memory>

#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/motions/motion.h"
#include "drivers/virtual_studio/people/anthropometry.h"

namespace mocap::simulation {

/// Of the path that people roll along.
inline constexpr double kRollRadius_mm = 1250;

/// Rolls along a path at constant speed. The hands push the wheels.
/// @param start_mm  position on the path at time 0.
std::unique_ptr<const Motion> MakeRoll(const Anthropometry& body, FloorPath path,
                                       double start_mm = 0);

}  // namespace mocap::simulation

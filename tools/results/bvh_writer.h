// Biovision's hierarchy files.
#pragma once

#include <iosfwd>

#include "tools/results/bvh_motion.h"

namespace mocap {

/// Writes a motion in centimetres and degrees, y up (see YUpFromWorld); rotations in the order Z,
/// X, Y, free of jumps from frame to frame.
void WriteBvh(const BvhMotion& motion, std::ostream& out);

}  // namespace mocap

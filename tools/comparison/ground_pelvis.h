// The pelvis' angles, which OpenSim's files give relative to their ground.
#pragma once

#include <string_view>
#include <vector>

#include "tools/comparison/alignment.h"

namespace mocap {

/// Whether an angle is one of pelvis_tilt, pelvis_list and pelvis_rotation.
bool IsOfGround(std::string_view angle);

/// Finds the turn about the vertical axis, and the shift, that bring another recording's pelvis
/// where ours is. Vertical axes of both grounds are the same: y of OpenSim's.
void AlignGrounds(const ResultMotion& own, const RecordedMotion& other, Alignment& alignment);

/// Expresses the pelvis' angles of another recording in our ground, near ours.
/// @param X  takes the other's points to our world; the other's ground has y up.
void ToOurGround(const ResultMotion& own, const RigidTransform& X, double offset_s,
                 RecordedMotion& other);

}  // namespace mocap

// Converts bodies and poses of messages to the tracker's types.
#pragma once

#include <mocap/pose_t.hpp>
#include <optional>

#include "core/body/body_model.h"
#include "core/body/pose_state.h"
#include "tools/results/result.h"

namespace mocap {

/// Whether sizes, from any sender, are plausible for a person.
bool AreSizes(const BodySizes& sizes);

/// Makes the body of a record; empty if its table is not built in or its sizes are implausible.
std::optional<BodyModel> ModelOf(const BodyRecord& record);

/// Returns the pose of a message, whose values are not validated. @pre  it has `num_joints` angles.
PoseState StateOf(const pose_t& pose);

}  // namespace mocap

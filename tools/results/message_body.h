// The bodies and poses of messages as the tracker has them.
#pragma once

#include <mocap/pose_t.hpp>
#include <optional>

#include "core/body/body_model.h"
#include "core/body/pose_state.h"
#include "tools/results/result.h"

namespace mocap {

/// Whether sizes are those of a person, whoever sent them.
bool AreSizes(const BodySizes& sizes);

/// Makes the body that a record is of; empty where its table is not built in or its sizes are
/// nobody's.
std::optional<BodyModel> ModelOf(const BodyRecord& record);

/// Reads the pose that a message tells of, which may be anything but has `num_joints` angles.
PoseState StateOf(const pose_t& pose);

}  // namespace mocap

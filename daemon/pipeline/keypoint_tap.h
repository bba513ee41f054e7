// Lets recordings copy the keypoints that arrive.
#pragma once

#include "core/evidence/keypoint_view.h"
#include "daemon/pipeline/tap.h"

namespace mocap {

using KeypointTap = Tap<KeypointView>;

}  // namespace mocap

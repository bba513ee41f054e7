// Where a recording gets its data from.
#pragma once

#include <deque>

#include "daemon/pipeline/keypoint_tap.h"
#include "daemon/pipeline/tap.h"

namespace mocap {

/// The daemon's threads offer their data here.
struct RecordingTaps {
  std::deque<FrameTap> frames;  ///< In the order of the cameras.
  MessageTap messages;          ///< That are published.
  // Of clients, offered by the thread that receives them.
  MessageTap received;
  KeypointTap keypoints;
};

}  // namespace mocap

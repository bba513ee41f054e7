// The second pass of a solve: the pose in each set from all sets around it.
#pragma once

#include <functional>
#include <span>

#include "core/motion_capture.h"
#include "core/solving/person_evidence.h"
#include "core/solving/pose_path.h"

namespace mocap {

/// A part of a path, and what is published of it.
struct PathPart {
  int first = 0;                    ///< Set of the first step.
  std::span<const PathStep> steps;  ///< With some before and after what is published.
  int begin = 0, end = 0;           ///< What is published: sets [begin, end).
};

/// Receives what was solved, set by set.
using SolvedSink = std::function<void(int set, const CaptureResult& result)>;

/// Filters a person of known sizes along a path, smooths the poses, and tells the contacts of their
/// feet. A set counts as much as its residuals are independent of those of other sets. Where nobody
/// was found for a short time, the motion goes on: these sets are bridged.
void SmoothPath(RecordedSets& sets, const PathPart& part, Things things, PersonEvidence& evidence,
                const SolvedSink& sink);

}  // namespace mocap

// The likeliest way through a person's hypotheses: the odds of the whole take decide.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/hypotheses/pose_filter.h"
#include "core/solving/hypothesis_run.h"

namespace mocap {

/// One set of a path.
struct PathStep {
  std::optional<PoseState> pose;  ///< Empty: nobody was found.
  Things things;
  bool jumps = false;      ///< The pose does not follow from the one before by any motion.
  double probability = 0;  ///< Of the pose, 0 to 1, given all sets.
};

/// Finds the sequence of candidates with the least -log p (Viterbi 1967): that of each set, worth
/// as much as live, and that of the motion from one to the next. A part of the body that jumps
/// costs no more than what live tracking asks for to drop a hypothesis, 1000 to 1: arms are
/// mistaken more easily than whole people.
/// @param sets    candidates of successive sets.
/// @param dt_s    time since the set before; as many.
/// @param body    of the candidates.
/// @param before  the pose in the set before the first, if it is decided.
std::vector<PathStep> LikeliestPath(std::span<const Candidates> sets, std::span<const double> dt_s,
                                    const BodyModel& body,
                                    const std::optional<PoseState>& before = {});

}  // namespace mocap

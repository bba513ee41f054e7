// Follows a person of known sizes through a part of a take, forward or backward in time.
#pragma once

#include <vector>

#include "core/objective/carried_things.h"
#include "core/solving/person_evidence.h"

namespace mocap {

/// A pose that a person may have in a set.
struct Candidate {
  PoseState pose;
  double nats = 0;  ///< -log p given the set alone.
  Things things;    ///< That the person wears or carries.
};
/// Those of a set. Empty: nobody was found.
using Candidates = std::vector<Candidate>;

/// The sets that a run goes through, in this order: from `first` to `last`, both included.
struct RunOver {
  int first = 0, last = 0;

  bool is_backward() const { return last < first; }
  int count() const { return (is_backward() ? first - last : last - first) + 1; }
  int at(int step) const { return is_backward() ? first - step : first + step; }
};

/// Follows the hypotheses about a person as live tracking does, with what is known at the end: the
/// sizes, and where everybody was. Time backward is as good as forward: the motion model is the
/// same.
/// @return  candidates in the order of the run.
std::vector<Candidates> FollowHypotheses(RecordedSets& sets, const RunOver& run,
                                         PersonEvidence& evidence);

}  // namespace mocap

// Finds the poses that explain the evidence best, for a person of any sizes. All poses are fitted,
// as in articulated ICP with many starting points. Most are far off, and few samples show that.
#pragma once

#include <vector>

#include "core/evidence/evidence.h"
#include "core/hypotheses/hypothesis.h"
#include "core/proposals/stance_library.h"

namespace mocap {

/// A pose of one of several bodies.
struct StanceCandidate {
  int body = 0;  ///< Index of the body.
  PoseState pose;
  double nats = 0;
  Things things = {};  ///< Those that it wears and carries.
};

/// What a search covers.
struct SearchScope {
  double effort = 1;           ///< Share of a full search, above 0: the share of poses fitted.
  Things things = kAnyThings;  ///< What a person may wear or carry.
};

/// Searches frame after frame: among the stances of a library, and the best of the previous frame.
class StanceSearch {
 public:
  /// Creates a search among people of all statures and builds.
  static StanceSearch OfStrangers(const BodyTable& table);
  /// Creates a search among the poses of one person.
  explicit StanceSearch(const BodyModel& body) : StanceSearch({body}, 1) {}

  const BodyModel& body(int index) const { return bodies_[index]; }

  /// Searches in the evidence of a frame; `frame` counts the evaluations.
  /// @return  the best distinct poses, the best first; valid until the next call.
  const std::vector<StanceCandidate>& Find(Objective& frame, const SearchScope& scope);

  /// Adds a pose to the best of the previous frame.
  void Remember(const BodySizes& sizes, const PoseState& pose);
  /// Forgets the best of the previous frame.
  void StartOver() { candidates_.clear(); }

 private:
  struct Round;
  // Bodies of a stature are adjacent, from the leanest to the stoutest, then one in a skirt.
  StanceSearch(std::vector<BodyModel> bodies, int builds);

  void Propose(const VoxelCloud& cloud);
  void ProposeNeighbours();
  // Fits all poses to the evidence and keeps the best.
  void Play(const Round& round, const SearchScope& scope, Objective& frame);
  void KeepDistinct();

  std::vector<BodyModel> bodies_;
  int builds_;
  std::vector<StanceLibrary> libraries_;  ///< One for each body.
  std::vector<StanceCandidate> candidates_;
  std::vector<PoseState> poses_;  ///< Only while they are proposed.
};

}  // namespace mocap

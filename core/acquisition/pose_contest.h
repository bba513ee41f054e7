// Beyond the paper: finds the pose that explains the evidence best. All poses are fitted, as in
// articulated ICP with many starting points. Most are far off, and few samples show that.
#pragma once

#include <vector>

#include "core/acquisition/pose_prior.h"
#include "core/acquisition/stance_library.h"
#include "core/body/body_model.h"
#include "core/tracking/evidence.h"
#include "core/tracking/surface_fit.h"

namespace mocap {

/// A pose of one of several bodies.
struct PoseCandidate {
  int body = 0;  ///< Index of the body.
  PoseState pose;
  double cost_mm = 0;  ///< Of the fit, and of the prior.
  Things things = {};  ///< Those that it wears and carries.
};

/// What a search covers.
struct SearchScope {
  double effort = 1;           ///< Share of a full search, above 0: the share of poses fitted.
  Things things = kAnyThings;  ///< What a person may wear or carry.
};

/// Compares poses with frame after frame: those of a library, and the best of the previous frame.
class PoseContest {
 public:
  /// Creates a contest among people of all statures and builds.
  static PoseContest OfStrangers(const BodyTable& table);
  /// Creates a contest among the poses of one person.
  explicit PoseContest(const BodyModel& body) : PoseContest({body}, 1) {}

  const BodyModel& body(int index) const { return bodies_[index]; }

  /// Processes a frame.
  /// @param prior   of its poses.
  /// @return  the best distinct poses, the best first; valid until the next call.
  const std::vector<PoseCandidate>& Hold(const Evidence& evidence, const PosePrior& prior,
                                         const SearchScope& scope);

  /// Adds a pose to the best of the previous frame.
  void Remember(const BodySizes& sizes, const PoseState& pose);
  /// Forgets the best of the previous frame.
  void StartOver() { candidates_.clear(); }

 private:
  struct Round;
  // Bodies of a stature are adjacent, from the leanest to the stoutest, then one in a skirt.
  PoseContest(std::vector<BodyModel> bodies, int builds);

  void Propose(const VoxelCloud& cloud);
  void ProposeNeighbours();
  // Fits all poses to the evidence and keeps the best.
  void Play(const Evidence& evidence, const PosePrior& prior, const Round& round,
            const SearchScope& scope);
  void KeepDistinct();

  std::vector<BodyModel> bodies_;
  int builds_;
  std::vector<StanceLibrary> libraries_;  ///< One for each body.
  std::vector<PoseCandidate> candidates_;
  std::vector<PoseState> poses_;  ///< Only while they are proposed.
};

}  // namespace mocap

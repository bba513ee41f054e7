// Beyond the paper: which of many poses explains the evidence best. All are drawn to it, as in
// articulated ICP with many starts; most are far off, and few samples tell.
#pragma once

#include <vector>

#include "core/acquisition/stance_library.h"
#include "core/body/body_model.h"
#include "core/tracking/evidence.h"
#include "core/tracking/surface_fit.h"

namespace mocap {

/// A pose of one of some bodies.
struct PoseCandidate {
  int body = 0;  ///< Which.
  PoseState pose;
  double cost_mm = 0;
};

/// Holds poses against frame after frame: those of a library, and the best of the frame before.
class PoseContest {
 public:
  /// Makes a contest among people of all statures and builds.
  static PoseContest OfStrangers(const BodyTable& table);
  /// Makes a contest among the poses of one person.
  explicit PoseContest(const BodyModel& body) : PoseContest({body}, 1) {}

  const BodyModel& body(int index) const { return bodies_[index]; }

  /// Takes a frame.
  /// @param effort  share of a whole search, above 0: so many poses are drawn to the evidence.
  /// @return  the best that differ, the best first; valid until the next call.
  const std::vector<PoseCandidate>& Hold(const Evidence& evidence, double effort);

  /// Adds a pose to the best of the frame before.
  void Remember(const BodySizes& sizes, const PoseState& pose);
  /// Forgets the best of the frame before.
  void StartOver() { candidates_.clear(); }

 private:
  struct Round;
  // Bodies of a stature stand together, from the leanest to the stoutest.
  PoseContest(std::vector<BodyModel> bodies, int builds);

  void Propose(const VoxelCloud& cloud);
  void ProposeNeighbours();
  // Draws all to the evidence and keeps the best.
  void Play(const Evidence& evidence, const Round& round, double effort);
  void KeepDistinct();

  std::vector<BodyModel> bodies_;
  int builds_;
  std::vector<StanceLibrary> libraries_;  ///< Of the bodies.
  std::vector<PoseCandidate> candidates_;
  std::vector<PoseState> poses_;  ///< While they are proposed.
};

}  // namespace mocap

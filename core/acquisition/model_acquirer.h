// Replaces §7 and Fig. 9: finds an unknown person and measures the body while tracking it.
#pragma once

#include <optional>
#include <vector>

#include "core/acquisition/facing_duel.h"
#include "core/acquisition/feet.h"
#include "core/acquisition/pose_contest.h"
#include "core/acquisition/size_refiner.h"
#include "core/tracking/tracker.h"

namespace mocap {

/// A body that is tracked while its sizes are refined.
struct BodyHypothesis {
  Tracker tracker;
  SizeRefiner sizes;
};

/// Acquires one person: finds a pose in the first frame, then tracks it and refines the sizes until
/// they stop changing.
class ModelAcquirer {
 public:
  explicit ModelAcquirer(const BodyTable& table);

  /// Searches for a body.
  /// @param known   sizes to keep; acquisition ends at once then.
  /// @param scope   what the search covers; further calls try again what failed before.
  /// @param walks_W  direction in which the person walks, if that is known.
  /// @return whether a body was found that explains the evidence.
  bool Locate(const Evidence& evidence, const std::optional<BodySizes>& known,
              const SearchScope& scope, const std::optional<Vector3>& walks_W = std::nullopt);

  /// Tests whether a body of other sizes explains the evidence clearly better than the one that was
  /// located with known sizes.
  /// @param effort  as in SearchScope.
  /// @pre Locate has succeeded.
  bool IsStranger(const Evidence& evidence, double effort);

  /// Treats the next person as somebody else.
  void StartOver();

  /// Tracks the located body through the next frame and refines its sizes. Follows a body that
  /// faces the opposite way beside it, until it is clear which is right.
  void Refine(const Evidence& evidence, double dt_s);

  /// Whether the sizes have stopped changing.
  bool settled() const { return settled_; }
  /// The body that faces the opposite way, as long as it is not clear which is right; otherwise
  /// null.
  const BodyHypothesis* opposite() const {
    return hypotheses_.size() < 2 ? nullptr : &hypotheses_[1];
  }
  /// The comparison of both so far.
  const FacingDuel& duel() const { return duel_; }
  /// The most likely body. @pre Locate has succeeded.
  const Tracker& best() const { return hypotheses_.front().tracker; }
  /// The size estimate from all frames so far. @pre as above.
  const SizeRefiner& sizes() const { return hypotheses_.front().sizes; }

 private:
  PosePrior PriorOf(const Evidence& evidence,
                    const std::optional<Vector3>& walks_W = std::nullopt) {
    return PosePrior(feet_.ToesBeforeShins(evidence.cloud), walks_W);
  }
  PoseContest& ContestFor(const std::optional<BodySizes>& known);
  BodyHypothesis Begin(const PoseContest& contest, const PoseCandidate& candidate,
                       const Evidence& evidence, bool measures);
  // Keeps the facing that has cost less so far first, and only it once that is clear.
  void CompareFacings(const PosePrior& prior, double dt_s);

  BodyTable table_;
  FeetFinder feet_;
  PoseContest strangers_;
  std::optional<PoseContest> acquainted_;  ///< For a person of known sizes.
  std::vector<BodyHypothesis>
      hypotheses_;  ///< The most likely first, then the one that faces the opposite way.
  int frames_ = 0;
  FacingDuel duel_;
  bool settled_ = false;
};

}  // namespace mocap

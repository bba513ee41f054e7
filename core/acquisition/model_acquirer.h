// Replaces §7 and Fig. 9: finds an unknown person and measures the body while tracking it.
#pragma once

#include <optional>
#include <vector>

#include "core/acquisition/feet.h"
#include "core/acquisition/pose_contest.h"
#include "core/acquisition/size_refiner.h"
#include "core/tracking/tracker.h"

namespace mocap {

/// Acquires one person: finds a pose in the first frame, then tracks it and refines the sizes until
/// they stop changing.
class ModelAcquirer {
 public:
  explicit ModelAcquirer(const BodyTable& table);

  /// Searches for a body.
  /// @param known   sizes to keep; acquisition ends at once then.
  /// @param effort  as for PoseContest::Hold. Further calls try again what failed before.
  /// @param walks_W  direction in which the person walks, if that is known.
  /// @return whether a body was found that explains the evidence.
  bool Locate(const Evidence& evidence, const std::optional<BodySizes>& known, double effort,
              const std::optional<Vector3>& walks_W = std::nullopt);

  /// Tests whether a body of other sizes explains the evidence clearly better than the one that was
  /// located with known sizes.
  /// @param effort  as above.
  /// @pre Locate has succeeded.
  bool IsStranger(const Evidence& evidence, double effort);

  /// Treats the next person as somebody else.
  void StartOver();

  /// Tracks the located body through the next frame and refines its sizes.
  void Refine(const Evidence& evidence, double dt_s);

  /// Whether the sizes have stopped changing and left and right are distinguished.
  bool settled() const { return settled_; }
  /// The most likely body. @pre Locate has succeeded.
  const Tracker& best() const { return hypotheses_.front().tracker; }
  /// The size estimate from all frames so far. @pre as above.
  const SizeRefiner& sizes() const { return hypotheses_.front().sizes; }

 private:
  struct Hypothesis {
    Tracker tracker;
    SizeRefiner sizes;
    double cost_sum = 0;
  };
  PosePrior PriorOf(const Evidence& evidence,
                    const std::optional<Vector3>& walks_W = std::nullopt) {
    return PosePrior(feet_.ToesBeforeShins(evidence.cloud), walks_W);
  }
  PoseContest& ContestFor(const std::optional<BodySizes>& known);
  Hypothesis Begin(const PoseContest& contest, const PoseCandidate& candidate,
                   const Evidence& evidence, const PosePrior& prior, bool measures);

  BodyTable table_;
  FeetFinder feet_;
  PoseContest strangers_;
  std::optional<PoseContest> acquainted_;  ///< For a person of known sizes.
  std::vector<Hypothesis>
      hypotheses_;  ///< The most likely first, then the one that faces the opposite way.
  int frames_ = 0;
  bool settled_ = false;
};

}  // namespace mocap

// §7: finds a person whom nobody has seen before and measures the body while following it. Fig. 9.
#pragma once

#include <optional>
#include <vector>

#include "core/acquisition/pose_contest.h"
#include "core/acquisition/size_refiner.h"
#include "core/tracking/tracker.h"

namespace mocap {

/// Acquires one person: find a pose in the first frame, then follow and refine the sizes until they
/// stop changing.
class ModelAcquirer {
 public:
  explicit ModelAcquirer(const BodyTable& table);

  /// Looks for a body.
  /// @param known   sizes to keep; acquisition is over at once then.
  /// @param effort  as for PoseContest::Hold. What was found before in vain is tried again.
  /// @return whether one was found that explains the evidence.
  bool Locate(const Evidence& evidence, const std::optional<BodySizes>& known, double effort);

  /// Whether a body of other sizes explains the evidence clearly better than the one that was
  /// located with known sizes.
  /// @param effort  as above.
  /// @pre Locate has succeeded.
  bool IsStranger(const Evidence& evidence, double effort);

  /// Takes whoever is seen next for somebody else.
  void StartOver();

  /// Follows the located body through the next frame and refines its sizes.
  void Refine(const Evidence& evidence, double dt_s);

  /// Whether the sizes have stopped changing and left is told from right.
  bool settled() const { return settled_; }
  /// The likeliest body. @pre Locate has succeeded.
  const Tracker& best() const { return hypotheses_.front().tracker; }
  /// The estimate of its sizes from all frames so far. @pre as above.
  const SizeRefiner& sizes() const { return hypotheses_.front().sizes; }

 private:
  struct Hypothesis {
    Tracker tracker;
    SizeRefiner sizes;
    double cost_sum = 0;
  };
  PoseContest& ContestFor(const std::optional<BodySizes>& known);
  Hypothesis Begin(const PoseContest& contest, const PoseCandidate& candidate,
                   const Evidence& evidence, bool measures);

  BodyTable table_;
  PoseContest strangers_;
  std::optional<PoseContest> acquainted_;  ///< With somebody whose sizes are known.
  std::vector<Hypothesis>
      hypotheses_;  ///< The likeliest first, then the one that faces the other way.
  int frames_ = 0;
  bool settled_ = false;
};

}  // namespace mocap

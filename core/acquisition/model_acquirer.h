// §7: finds a person whom nobody has seen before and measures the body while following it. Fig. 9.
#pragma once

#include <optional>
#include <vector>

#include "core/acquisition/body_localizer.h"
#include "core/acquisition/body_size_network.h"
#include "core/tracking/tracker.h"

namespace mocap {

/// Acquires one person: locate in the first frame, then follow and refine the sizes until they stop
/// changing.
class ModelAcquirer {
 public:
  ModelAcquirer(const BodyTable& table, const BodyProportions& proportions)
      : table_(table), network_(proportions) {}

  /// Looks for a body. With `known` sizes they are kept and acquisition is over at once; else each
  /// call tries some statures, and what none of them explains well is found after a few calls.
  /// @return whether one was found that explains the voxels.
  bool Locate(const Evidence& evidence, const std::optional<BodySizes>& known);

  /// Takes whoever is seen next for somebody else.
  void StartOver() { next_stature_ = 0; }

  /// Follows the located body through the next frame and refines its sizes.
  void Refine(const Evidence& evidence, double dt_s);

  /// Whether the sizes have stopped changing and left is told from right.
  bool settled() const { return settled_; }
  /// The likeliest body. @pre Locate has succeeded.
  const Tracker& best() const { return hypotheses_.front().tracker; }

 private:
  struct Hypothesis {
    Tracker tracker;
    double cost_sum = 0;
    BodySizes measured{};  ///< Mean over the frames so far.
  };
  bool TryStature(const Evidence& evidence);
  void Begin(const std::vector<Tracker>& found, const Evidence& evidence);
  double RefineSizes(Hypothesis& hypothesis, bool remember);

  BodyTable table_;
  BodySizeNetwork network_;
  std::vector<Hypothesis>
      hypotheses_;  ///< The likeliest first, then the one that faces the other way.
  double height_mm_ = 0;
  bool is_upright_ = true;  ///< Then the height tells of the lengths.
  int next_stature_ = 0;    ///< The next to try.
  double likely_stature_ = 1;
  double likely_cost_mm_ = 0;
  int frames_ = 0;
  bool settled_ = false;
};

}  // namespace mocap

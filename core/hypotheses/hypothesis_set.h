// A person's hypotheses: odds decide between them.
#pragma once

#include <vector>

#include "core/hypotheses/hypothesis.h"

namespace mocap {

/// How odds decide.
struct Odds {
  /// Residuals of frames this close in time correlate by 0.7 (`mocap benchmark --parts noise`).
  double alike_s = 0.1;
  double change = 19, drop = 1000;  ///< 19 to 1 change the mind; 1 to 1000 end a hypothesis.
  std::size_t most = 4;             ///< Hypotheses.
  /// A pose that is worse by this than the believed one before it is fitted is not fitted: of 149
  /// that were worse by 80, in three takes, one was better after the fit.
  double hopeless_nats = 70;
  double same_mm = 30;  ///< Mean distance of the points of poses that are equal.
  /// Larger differences between motion and prediction are out of reach of a fit.
  double leap_mm = 50;
};
inline constexpr Odds kOdds{};

/// A frame's -log p counts this much, because residuals all over a body err alike. With 0.1 to 0.4,
/// depending on how hard the frames are, the odds of right and wrong poses are as often right as
/// they say (`mocap benchmark --parts noise`).
inline constexpr double kFrameWorth = 0.25;
/// The same for a frame that follows another one closely: all frames within 0.1 s count as one.
double FrameWorth(double dt_s);

/// What a view of a pose network counts beside that: hair, hats and wheels mislead silhouettes for
/// as long as they are there, so that frames are worth less than they seem where views contradict
/// them. Of 1, 4 and 10, the best for 45 varied people.
inline constexpr double kViewWorth = 4;

/// A few explanations of one person. One frame does not tell arms that cross from arms that touch,
/// the front of a person in a skirt from the back, or a limb from a ghost; some frames do.
///
/// Each hypothesis follows the person with its own filter. Its -log p is integrated over capture
/// time: successive frames err alike, so that all frames within 0.1 s count as one. One of two
/// that have become the same pose goes, and so does whatever is a thousand times less probable than
/// the best.
class HypothesisSet {
 public:
  void Clear() { hypotheses_.clear(); }
  bool empty() const { return hypotheses_.empty(); }

  /// Begins with some hypotheses, of which the first is believed. @pre not empty
  /// @param middle_W  of the voxels, if the next frame is to be followed.
  void Begin(std::vector<Hypothesis> hypotheses,
             const std::optional<Vector3>& middle_W = std::nullopt);
  /// Predicts all hypotheses, fits them to the next frame and weighs them.
  void Follow(Objective& objective, double dt_s);
  /// Adds a pose that a body may have instead, as of this frame. If it is likelier, it takes over
  /// the trials. @param present  a copy of one of the set.
  void Vary(Objective& objective, Hypothesis& present, const PoseState& pose);
  /// Adds a hypothesis that was fitted to this frame. One that is a known pose keeps what spoke
  /// against that.
  void Offer(Hypothesis hypothesis);
  /// Merges, drops, and believes another one if its odds are 19 to 1.
  void Judge();

  /// The hypothesis that is believed. @pre not empty
  Hypothesis& best() { return hypotheses_.front(); }
  const Hypothesis& best() const { return hypotheses_.front(); }
  /// The probability of one of the set, as far as the set has the right one.
  double ProbabilityOf(const Hypothesis& one) const;
  /// The likeliest of the others. Null: there are none.
  const Hypothesis* Rival() const;
  std::vector<Hypothesis>& all() { return hypotheses_; }
  const std::vector<Hypothesis>& all() const { return hypotheses_; }
  /// How much a fitness in the last frame counts [nats]. Views of pose networks count fully,
  /// however close the frames are in time: each tells its own worth.
  double NatsOf(const Fitness& fitness) const;
  /// How often the mind has been changed.
  int changes() const { return changes_; }

 private:
  void Keep(Hypothesis removed);
  void Remove(std::size_t i);
  void Merge();
  void Drop();

  std::vector<Hypothesis> hypotheses_;  ///< The first is believed.
  std::optional<Vector3> middle_W_;     ///< Of the voxels of the previous frame.
  std::vector<Hypothesis> removed_;     ///< A few, only to reuse their memory.
  double worth_ = kFrameWorth;
  int changes_ = 0;
};

}  // namespace mocap

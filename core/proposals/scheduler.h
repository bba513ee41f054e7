// Where a person's pose is in doubt, other poses are proposed, as far as the budget goes.
#pragma once

#include <optional>
#include <vector>

#include "core/hypotheses/hypothesis_set.h"
#include "core/proposals/limb_proposals.h"
#include "core/proposals/stance_search.h"

namespace mocap {

/// Effort of a search within the time of a frame: the first search is a full one, later ones are
/// limited to about the available time.
double EffortWithin(double dt_s);

/// Proposes poses. The budget is counted in evaluations of the objective per second of capture
/// time.
///
/// Whenever pose networks have looked, what they suggest is tried. While no part explains some
/// rays, each arm and leg is tried elsewhere, then both arms and both legs. If the fit is bad or
/// the person faces backwards, whole stances are tried. A newcomer has all limbs tried first.
/// Rounds without a change of mind are repeated after longer and longer rests.
class Scheduler {
 public:
  explicit Scheduler(const BodyTable& table)
      : table_(table), strangers_(StanceSearch::OfStrangers(table)), limbs_(table) {}

  /// Forgets the person.
  void StartOver();
  /// Begins with somebody who was found.
  void BeginRounds();

  /// Finds hypotheses about the person who is there.
  /// @param known   sizes to keep; empty: they are measured.
  /// @param scope   what the search covers.
  std::vector<Hypothesis> FindAnybody(Objective& objective, const std::optional<BodySizes>& known,
                                      const SearchScope& scope);
  /// Proposes poses for a frame, where the believed hypothesis is in doubt.
  /// @param sizes_are_known  whether other sizes need not be tried.
  /// @param dt_s             time since the frame before.
  void Try(Objective& objective, HypothesisSet& hypotheses, bool sizes_are_known, double dt_s);

 private:
  StanceSearch& SearchFor(const std::optional<BodySizes>& known);
  // Tries one limb, or a pair after the limbs, elsewhere.
  void TryLimbs(std::size_t which, Objective& objective, const Hypothesis& present,
                HypothesisSet& hypotheses);
  void TryKeypoints(Objective& objective, HypothesisSet& hypotheses);
  // Tries a limb of a hypothesis that is on trial; false: there is none.
  bool TryNewcomer(Objective& objective, HypothesisSet& hypotheses);
  // Goes on with the present round; false: it rests.
  bool GoOn(Objective& objective, HypothesisSet& hypotheses, bool sizes_are_known, double dt_s);
  void TryStances(Objective& objective, HypothesisSet& hypotheses, bool sizes_are_known,
                  double dt_s);

  BodyTable table_;
  StanceSearch strangers_;
  std::optional<StanceSearch> acquainted_;  ///< For a person of known sizes.
  LimbProposals limbs_;
  std::vector<PoseState> poses_;
  std::optional<Hypothesis> varied_;  ///< Only to reuse its memory.
  std::size_t next_ = 0;              ///< Limb; pair after the limbs; stances at the end.
  double allowance_ = 0;              ///< Evaluations that may be spent.
  double rest_s_ = 0;                 ///< Until the next round,
  double vain_share_ = 0;             ///< unless clearly more than this is unexplained.
  double rest_after_s_ = 0;           ///< Length of the last rest.
  int changes_before_ = 0;            ///< Changes of mind before this round.
};

}  // namespace mocap

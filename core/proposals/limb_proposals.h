// §6.2: poses with limbs elsewhere, by the evidence that they should explain and not by their
// distance from the prediction.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/hypotheses/hypothesis.h"
#include "core/proposals/limb_objective.h"

namespace mocap {

inline constexpr std::array<Segment, 4> kLimbEnds = {Segment::kHandL, Segment::kHandR,
                                                     Segment::kToesL, Segment::kToesR};
using LimbPair = std::pair<Segment, Segment>;
inline constexpr std::array<LimbPair, 2> kLimbPairs = {
    {{Segment::kHandL, Segment::kHandR}, {Segment::kToesL, Segment::kToesR}}};

/// Proposes poses for a hypothesis that differ from its own in some limbs. The results are appended
/// to a list, the best first. Reuses its memory.
class LimbProposals {
 public:
  explicit LimbProposals(const BodyTable& table);

  /// One limb in other places.
  void Elsewhere(Objective& objective, const Hypothesis& present, Segment limb_end,
                 std::vector<PoseState>& poses);
  /// Both arms or both legs, because each may have taken the other's place.
  void Both(Objective& objective, const Hypothesis& present, const LimbPair& limb_ends,
            std::vector<PoseState>& poses);

 private:
  struct Candidate {
    PoseState pose;
    double nats;
  };

  const std::vector<JointAngles>& StancesOf(Segment limb_end) const;
  // The limb in each stance, the best first;
  template <typename Cost>
  void Rank(const std::vector<JointAngles>& stances, const PoseState& pose, const Cost& cost);
  // only the first of those with the limb's end in the same place;
  void KeepDistinct(std::size_t count);
  // refined, the best first.
  void Refine();
  void FindBest(Segment limb_end, const PoseState& pose, std::size_t refined, std::size_t count);

  std::vector<JointAngles> arm_stances_, leg_stances_;
  LimbObjective limb_;
  std::vector<Candidate> candidates_;
  std::vector<Candidate> firsts_;  ///< The first limb of a pair.
  std::vector<Vector3> tips_W_;
};

}  // namespace mocap

// §6.2: recovers a lost limb by the evidence that it should explain, not by its distance from the
// prediction.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/stance.h"
#include "core/tracking/contact_matcher.h"
#include "core/tracking/evidence.h"
#include "core/tracking/limb_search.h"
#include "core/tracking/surface_fit.h"

namespace mocap {

/// If no part explains some outlines, each arm and leg is tried in many stances. If that does not
/// help, both arms or both legs are tried together, because each may have taken the other's place.
/// After a failed search, it rests until more of the outline is unexplained, or for a time that is
/// shorter if there is more. Arms whose hands are close together are also tried exchanged, even if
/// everything is explained, and again whenever the hands have moved. Where frames are rare, legs
/// are tried exchanged when a lost limb was found, for it may be the other's. At the first call,
/// legs are tried exchanged, and both arms are searched, whatever is explained. Only what the rest
/// of the body does not explain is matched, so that a stance costs microseconds. Reuses its memory.
class LimbRecovery {
 public:
  explicit LimbRecovery(const BodyTable& table);

  /// Searches for a pose that explains clearly more of the evidence than `pose`, with limbs in
  /// other positions. At the first call less will do, because there is nothing to lose.
  /// @param fit      holds the evidence.
  /// @param quality  of the fit at that pose.
  /// @param dt_s     time since the last call; it limits the extent of the search. The first call
  /// searches everything.
  std::optional<PoseState> Recover(const BodyModel& body, const Evidence& evidence, SurfaceFit& fit,
                                   const PoseState& pose, const SurfaceFitQuality& quality,
                                   double dt_s);

  struct Candidate {
    PoseState pose;
    double cost_mm;
  };
  /// The best pose that the last call tried and did not return, if it costs about as much as `pose`
  /// or less: the next frames will show which is right.
  const std::optional<Candidate>& rival() const { return rival_; }

 private:
  // A stance of one limb of a pair.
  struct Option {
    PoseState pose;
    LimbClaim claim;
  };

  const std::vector<JointAngles>& StancesOf(Segment limb_end) const;
  bool IsExplained(const BodyModel& body, const PoseState& pose);
  // Replaces `present`, whose body is fitted to the evidence, if another pose explains it better.
  bool RecoverOne(const BodyModel& body, const Evidence& evidence, Segment limb_end,
                  SurfaceFit& fit, Candidate& present);
  // Replaces `present` if both limbs of a pair explain it better in other stances. `stances` fills
  // candidates_ with what to try for the first limb, searched with the second absent.
  template <typename Stances>
  bool OfferPair(const BodyModel& body, const Evidence& evidence,
                 const std::pair<Segment, Segment>& limb_ends, SurfaceFit& fit,
                 const Stances& stances, double gain_mm, Candidate& present);
  bool RecoverPair(const BodyModel& body, const Evidence& evidence,
                   const std::pair<Segment, Segment>& limb_ends, SurfaceFit& fit,
                   Candidate& present);
  // Continues a search as far as is allowed.
  bool RecoverLost(const BodyModel& body, const Evidence& evidence, SurfaceFit& fit,
                   Candidate& present);
  void StartOver();
  // A failed search would fail again until the body has moved.
  bool IsWorthSearching(double unexplained_share) const;
  // Tries exchanged limbs: hands that cross look as if they had touched and gone back, until they
  // part.
  bool Exchange(const BodyModel& body, const Evidence& evidence,
                const std::pair<Segment, Segment>& limb_ends, SurfaceFit& fit, Candidate& present);
  // Whether hands are close together, and not as they were when arms were last exchanged.
  bool HandsMeetAnew(const BodyModel& body, const PoseState& pose);

  // Fits the whole body to the evidence, starting at a candidate's pose.
  static void DrawNear(const BodyModel& body, SurfaceFit& fit, Candidate& candidate);
  // How much less a pose must cost to be taken at once [mm]. @param first_mm  in the first frame.
  double GainToTake(double first_mm) const { return is_first_ ? first_mm : sure_mm_; }
  // Replaces `present` by a pose that costs less by `gain_mm`. One that does not may be the rival.
  bool Offer(const Candidate& offered, double gain_mm, Candidate& present);

  // These fill candidates_: the limb in each stance, the cheapest first;
  template <typename Cost>
  void Rank(const LimbSearch& search, const std::vector<JointAngles>& stances,
            const PoseState& pose, const Cost& cost_mm);
  // only the first of those with the limb's end in the same place;
  void KeepDistinct(LimbSearch& search, std::size_t count);
  // refined, the best first;
  void Refine(LimbSearch& search);
  // all of the above;
  void FindBest(LimbSearch& search, const std::vector<JointAngles>& stances, const PoseState& pose,
                std::size_t count);
  // the stances with the limb's end nearest to a point, refined, the best first.
  void FindTowards(LimbSearch& search, const std::vector<JointAngles>& stances,
                   const PoseState& pose, const Vector3& p_WQ);
  // Returns candidates_ with their claims. Uses as much of `memory` as needed.
  std::span<const Option> Claims(LimbSearch& search, std::vector<Option>& memory);

  std::vector<JointAngles> arm_stances_;
  std::vector<JointAngles> leg_stances_;
  bool is_first_ = true;         ///< Nobody was searched yet.
  std::size_t next_ = 0;         ///< Limb, or pair after the limbs, to search next.
  bool is_in_vain_ = true;       ///< The search so far.
  double allowance_ = 0;         ///< Number of limbs that may be searched in this frame.
  double sure_mm_ = 0;           ///< Gain that is taken at once after the first frame.
  std::size_t pairs_drawn_ = 1;  ///< Of each two limbs, in this frame.
  double rest_s_ = 0;            ///< Until a failed search is repeated.
  double begun_share_ = 0;       ///< Unexplained share of the outline when the search began,
  double vain_share_ = 0;        ///< and when the last failed one began.
  std::optional<Candidate> rival_;
  std::optional<Vector3> hands_met_T_;  ///< From right to left, when exchanged arms were tried.
  std::vector<Contact> contacts_;
  ContactMatcher matcher_;
  std::vector<PosedCapsule> posed_;
  LimbSearch search_;
  LimbSearch other_search_;
  std::vector<Candidate> candidates_;
  std::vector<Candidate> pairs_;
  std::vector<Option> lefts_;
  std::vector<Option> rights_;
  std::vector<Vector3> tips_W_;
};

}  // namespace mocap

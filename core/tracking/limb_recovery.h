// §6.2: finds a limb again that has been lost, by what it should explain and not by its distance
// from the prediction.
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

/// Tries each arm and leg in many stances when outlines are left that no part explains, and both
/// arms or both legs together when that does not help: each may have taken the other's place. What
/// a search left it would leave again: it rests until more of the outline is unexplained, or for a
/// while that is the shorter the more there is. Arms whose hands are near each other are tried
/// exchanged even when all is explained, again whenever the hands have moved, and so are the legs
/// at the first look. Only what the rest of the body does not explain is matched, so that a stance
/// costs microseconds. Reuses its memory.
class LimbRecovery {
 public:
  explicit LimbRecovery(const BodyTable& table);

  /// Looks for a pose that explains clearly more of the evidence than `pose` does, by other places
  /// of the limbs.
  /// @param fit      holds the evidence.
  /// @param quality  of the fit at that pose.
  /// @param dt_s     since the last call: so much is searched. At the first call all is.
  std::optional<PoseState> Recover(const BodyModel& body, const Evidence& evidence, SurfaceFit& fit,
                                   const PoseState& pose, const SurfaceFitQuality& quality,
                                   double dt_s);

 private:
  struct Candidate {
    PoseState pose;
    double cost_mm;
  };
  // A stance of a limb that is one of a pair.
  struct Option {
    PoseState pose;
    LimbClaim claim;
  };

  const std::vector<JointAngles>& StancesOf(Segment limb_end) const;
  bool IsExplained(const BodyModel& body, const PoseState& pose);
  // `present`, whose whole body is drawn to the evidence, becomes what explains it better.
  bool RecoverOne(const BodyModel& body, const Evidence& evidence, Segment limb_end,
                  SurfaceFit& fit, Candidate& present);
  // `stances` makes candidates_ of what to try of the first limb, searched with the second absent.
  template <typename Stances>
  Candidate BestPair(const BodyModel& body, const Evidence& evidence, Segment left, Segment right,
                     SurfaceFit& fit, const Stances& stances, const PoseState& pose);
  bool RecoverPair(const BodyModel& body, const Evidence& evidence,
                   const std::pair<Segment, Segment>& limb_ends, SurfaceFit& fit,
                   Candidate& present);
  // Goes on with a search as far as is allowed.
  bool RecoverLost(const BodyModel& body, const Evidence& evidence, SurfaceFit& fit,
                   Candidate& present);
  void StartOver();
  // A search that failed would fail again until the body has moved on.
  bool IsWorthSearching(double unexplained_share) const;
  // Hands that cross look as if they had touched and gone back, until they are apart again.
  bool Exchange(const BodyModel& body, const Evidence& evidence,
                const std::pair<Segment, Segment>& limb_ends, SurfaceFit& fit, Candidate& present);
  // Whether hands are near each other, and not as they were when the arms were exchanged last.
  bool HandsMeetAnew(const BodyModel& body, const PoseState& pose);

  // Draws the whole body to the evidence from a candidate's pose.
  static void DrawNear(const BodyModel& body, SurfaceFit& fit, Candidate& candidate);

  // Make candidates_: the limb in each of the stances, the cheapest first;
  template <typename Cost>
  void Rank(const LimbSearch& search, const std::vector<JointAngles>& stances,
            const PoseState& pose, const Cost& cost_mm);
  // of those that put the limb's end in the same place only the first;
  void KeepDistinct(LimbSearch& search, std::size_t count);
  // improved, the best first;
  void Refine(LimbSearch& search);
  // all of that;
  void FindBest(LimbSearch& search, const std::vector<JointAngles>& stances, const PoseState& pose,
                std::size_t count);
  // the stances that put the limb's end nearest to a place, improved, the best first.
  void FindTowards(LimbSearch& search, const std::vector<JointAngles>& stances,
                   const PoseState& pose, const Vector3& p_WQ);
  // candidates_ with what they claim. Takes of `memory` as much as it needs.
  std::span<const Option> Claims(LimbSearch& search, std::vector<Option>& memory);

  std::vector<JointAngles> arm_stances_;
  std::vector<JointAngles> leg_stances_;
  bool is_first_ = true;    ///< Nobody was looked at yet.
  std::size_t next_ = 0;    ///< Limb, or pair behind the limbs, that is looked for next.
  bool is_in_vain_ = true;  ///< The search so far.
  double allowance_ = 0;    ///< How many limbs may be looked for in this frame.
  double rest_s_ = 0;       ///< Until what was searched in vain is searched again.
  double begun_share_ = 0;  ///< Of the outline, unexplained when the search began,
  double vain_share_ = 0;   ///< and when the last one in vain did.
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

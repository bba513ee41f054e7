// §6.2: finds a limb again that has been lost, by what it should explain and not by its distance
// from the prediction.
#pragma once

#include <optional>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/stance.h"
#include "core/tracking/contact_matcher.h"
#include "core/tracking/evidence.h"
#include "core/tracking/surface_fit.h"

namespace mocap {

/// Tries each arm and leg in many stances when outlines are left that no part explains, and both
/// arms or both legs together when that does not help: each may have taken the other's place. Arms
/// whose hands are near each other are tried exchanged even when all is explained. Only what the
/// rest of the body does not explain is matched, so that a stance costs microseconds.
class LimbRecovery {
 public:
  LimbRecovery();

  /// Looks for a pose that explains clearly more of the evidence than `pose` does, changing the
  /// limbs alone.
  /// @param fit      holds the evidence.
  /// @param quality  of the fit at that pose.
  /// @param dt_s     since the last call: after a search in vain there is a rest.
  std::optional<PoseState> Recover(const BodyModel& body, const Evidence& evidence, SurfaceFit& fit,
                                   const PoseState& pose, const SurfaceFitQuality& quality,
                                   double dt_s);

 private:
  const std::vector<Stance>& StancesOf(Segment limb_end) const;
  bool IsExplained(const BodyModel& body, const PoseState& pose);
  bool RecoverOne(const BodyModel& body, const Evidence& evidence, Segment limb_end,
                  PoseState& pose);
  // `stances` gives what to try of the first limb, searched with the second absent.
  template <typename Stances>
  bool RecoverPair(const BodyModel& body, const Evidence& evidence, Segment left, Segment right,
                   SurfaceFit& fit, const Stances& stances, PoseState& pose);
  bool RecoverLost(const BodyModel& body, const Evidence& evidence, SurfaceFit& fit,
                   PoseState& pose);
  // Hands that cross look as if they had touched and gone back.
  bool ExchangeArms(const BodyModel& body, const Evidence& evidence, SurfaceFit& fit,
                    PoseState& pose);
  static bool HandsMeet(const BodyModel& body, const PoseState& pose);

  std::vector<Stance> arm_stances_;
  std::vector<Stance> leg_stances_;
  double rest_s_ = 0;  ///< Until lost limbs are searched again.
  std::vector<Contact> contacts_;
  ContactMatcher matcher_;
  std::vector<PosedCapsule> posed_;
};

}  // namespace mocap

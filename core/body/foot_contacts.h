// Beyond the paper: which parts of the feet touch the floor, z = 0.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>

#include "core/body/body_model.h"

namespace mocap {

/// How likely heels and toes touch the floor, 0 to 1, in the order of kContactPoints; NaN: not
/// known.
using Contacts = Eigen::Matrix<double, 1, kContactCount>;
inline const Contacts kUnknownContacts =
    Contacts::Constant(std::numeric_limits<double>::quiet_NaN());

/// What is likelier than this counts as a contact.
inline constexpr double kContactLimit = 0.5;

/// Odds of a contact by height and speed of a part of the foot, as `mocap benchmark --parts noise`
/// measures them at tracked poses of simulated people: log odds are
/// `resting + per_mm z + per_log_speed ln(1 + v / kStandingSpeed_mm_s)` [nats].
struct ContactOdds {
  double resting, per_mm, per_log_speed;
};

/// Speed that noise alone gives the points of a foot that stands: slower ones tell nothing more
/// [mm/s].
inline constexpr double kStandingSpeed_mm_s = 30;

/// Height above the floor and speed of a heel or of the toes.
struct FootMotion {
  double height_mm, speed_mm_s;
};

using FootMotions = std::array<FootMotion, kContactCount>;

/// Heels, toes and balls of the left and the right foot; 3 × 6 [mm].
using FootPlaces = Eigen::Matrix<double, 3, 6>;
FootPlaces FootPlacesOf(const FurtherPoints& further_W);

/// What contacts are judged by. A foot that rolls off stands on its ball, then on its toes: the
/// toes' motion is that of whichever is lower, or slower.
/// @param velocity_W  of the places [mm/s].
FootMotions MotionsOf(const FootPlaces& places_W, const FootPlaces& velocity_W);
/// How likely heels and toes touch the floor.
Contacts ContactsOf(const FootMotions& motions);

/// Tells contacts by the motion of a body's feet.
class FootContacts {
 public:
  /// Forgets the frame before.
  void Reset() { before_W_.reset(); }

  /// Returns the contacts of a frame. Unknown without an earlier frame, and for a body whose feet
  /// do not turn.
  Contacts Update(const BodyModel& body, const Posture& posture, double dt_s);

  /// What Update judged last.
  const FootMotions& motions() const { return motions_; }

 private:
  std::optional<FootPlaces> before_W_;  ///< Follows the places.
  FootMotions motions_{};
};

}  // namespace mocap

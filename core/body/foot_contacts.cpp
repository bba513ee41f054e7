#include "core/body/foot_contacts.h"

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

// Time constant of the points that speeds are measured against [s]: at 100 Hz, noise from frame to
// frame would pass for motion.
constexpr double kSpeedTime_s = 0.02;
// Of 40 people. With 90, of whom hardly anybody holds a raised heel still, height would count half
// as much for heels.
constexpr ContactOdds kHeelOdds{8.77, -0.1003, -2.46}, kToeOdds{7.43, -0.1199, -2.29};

double ShareOf(const ContactOdds& odds, const FootMotion& motion) {
  const double nats = odds.resting + odds.per_mm * motion.height_mm +
                      odds.per_log_speed * std::log1p(motion.speed_mm_s / kStandingSpeed_mm_s);
  return 1 / (1 + std::exp(-nats));
}

bool IsHeel(int contact) { return contact < 2; }

}  // namespace

FootPlaces FootPlacesOf(const FurtherPoints& further_W) {
  const auto pair = [&](Point left) {
    return further_W.middleCols<2>(static_cast<int>(left) - kPointCount);
  };
  FootPlaces places_W;
  places_W << pair(Point::kHeelL), pair(Point::kToeL), pair(Point::kBallL);
  return places_W;
}

FootMotions MotionsOf(const FootPlaces& places_W, const FootPlaces& velocity_W) {
  const auto motion_of = [&](int i) {
    return FootMotion{places_W(2, i), velocity_W.col(i).norm()};
  };
  FootMotions motions;
  for (int i = 0; i < kContactCount; ++i) {
    motions[i] = motion_of(i);
    if (IsHeel(i)) continue;
    const FootMotion ball = motion_of(i + 2);
    motions[i].height_mm = std::min(motions[i].height_mm, ball.height_mm);
    motions[i].speed_mm_s = std::min(motions[i].speed_mm_s, ball.speed_mm_s);
  }
  return motions;
}

Contacts ContactsOf(const FootMotions& motions) {
  Contacts contacts;
  for (int i = 0; i < kContactCount; ++i)
    contacts[i] = ShareOf(IsHeel(i) ? kHeelOdds : kToeOdds, motions[i]);
  return contacts;
}

Contacts FootContacts::Update(const BodyModel& body, const Posture& posture, double dt_s) {
  const FootPlaces now_W = FootPlacesOf(body.FurtherPointsAt(posture));
  if (!now_W.allFinite()) {
    before_W_.reset();
    return kUnknownContacts;
  }
  if (!before_W_ || dt_s <= 0) {
    before_W_ = now_W;
    return kUnknownContacts;
  }
  const double share = 1 - std::exp(-dt_s / kSpeedTime_s);
  const FootPlaces moved_W = share * (now_W - *before_W_);
  motions_ = MotionsOf(now_W, moved_W / dt_s);
  *before_W_ += moved_W;
  return ContactsOf(motions_);
}

}  // namespace mocap

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

}  // namespace

FootContacts::FootPoints FootContacts::PointsOf(const FurtherPoints& further_W) {
  const auto pair = [&](Point left) {
    return further_W.middleCols<2>(static_cast<int>(left) - kPointCount);
  };
  FootPoints points_W;
  points_W << pair(Point::kHeelL), pair(Point::kToeL), pair(Point::kBallL);
  return points_W;
}

Contacts FootContacts::Update(const BodyModel& body, const Posture& posture, double dt_s) {
  const FootPoints now_W = PointsOf(body.FurtherPointsAt(posture));
  if (!now_W.allFinite()) {
    before_W_.reset();
    return kUnknownContacts;
  }
  if (!before_W_ || dt_s <= 0) {
    before_W_ = now_W;
    return kUnknownContacts;
  }
  const double share = 1 - std::exp(-dt_s / kSpeedTime_s);
  const FootPoints moved_W = share * (now_W - *before_W_);
  const auto motion_of = [&](int i) {
    return FootMotion{now_W(2, i), moved_W.col(i).norm() / dt_s};
  };
  Contacts contacts;
  for (int i = 0; i < kContactCount; ++i) {
    motions_[i] = motion_of(i);
    const bool is_heel = i < 2;
    if (!is_heel) {
      // A foot that rolls off stands on its ball, then on its toes.
      const FootMotion ball = motion_of(i + 2);
      motions_[i].height_mm = std::min(motions_[i].height_mm, ball.height_mm);
      motions_[i].speed_mm_s = std::min(motions_[i].speed_mm_s, ball.speed_mm_s);
    }
    contacts[i] = ShareOf(is_heel ? kHeelOdds : kToeOdds, motions_[i]);
  }
  *before_W_ += moved_W;
  return contacts;
}

}  // namespace mocap

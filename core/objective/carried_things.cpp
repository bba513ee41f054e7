#include "core/objective/carried_things.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mocap {
namespace {

struct ThingSizes {
  double hat_mm = 200;                      // From the middle of the skull.
  double pack_mm = 280, pack_side_mm = 30;  // Behind the spine, and beside the trunk.
  // Around a hanging bag, and its length as a share of the stature.
  double bag_mm = 150, bag_share = 0.25;
  double seat_share = 0.35;    // From the hips to a wheel's far end, of the stature.
  double above_hips_mm = 100;  // Armrests and wheels rise above the hip joints.
  // A thigh is level with a smaller slope; a trunk is upright and a forearm hangs with a greater.
  double level = 0.6, upright = 0.7;
  // Middle of the skull, and the lower border of hair, from the head's centre, as shares of its
  // size.
  double skull_share = 0.25;
};
constexpr ThingSizes kThings{};

double Slope(const Vector3& from_W, const Vector3& to_W) {
  const Vector3 way_W = to_W - from_W;
  return way_W.z() / way_W.norm();
}

PosedCapsule Around(const Vector3& p_W, double radius_mm) {
  return {p_W, p_W, radius_mm, radius_mm};
}

bool Reaches(const PosedCapsule& place, const Contact& contact) {
  return place.DistanceTo(contact.from_W, contact.to_W).outside_mm < 0;
}

}  // namespace

ThingPlaces::ThingPlaces(const BodyModel& body, const Posture& posture, Things allowed)
    : allowed_(allowed), X_WT_(posture.X_WT), head_(Around(Vector3::Zero(), 0)), back_(head_) {
  const BodySizes& sizes = body.sizes();
  const BodyPoints points_W = body.PointsAt(posture);
  const auto at = [&](Point point) -> Vector3 { return points_W.col(static_cast<int>(point)); };
  up_W_ = (at(Point::kHead) - at(Point::kNeck)).normalized();
  chin_W_ = at(Point::kHead) - kThings.skull_share * sizes.head * up_W_;
  head_ = Around(at(Point::kHead) + kThings.skull_share * sizes.head * up_W_, kThings.hat_mm);
  back_ = PosedCapsule(X_WT_ * Vector3(0, 0, -sizes.torso / 4),
                       X_WT_ * Vector3(0, 0, sizes.torso / 2), kThings.pack_mm, kThings.pack_mm);
  behind_mm_ = 0.4 * sizes.torso_depth;
  beside_mm_ = sizes.torso_width / 2 + kThings.pack_side_mm;
  const auto is_level = [&](Point hip, Point knee) {
    return std::abs(Slope(at(hip), at(knee))) < kThings.level;
  };
  if (X_WT_.R(2, 2) > kThings.upright && is_level(Point::kHipL, Point::kKneeL) &&
      is_level(Point::kHipR, Point::kKneeR)) {
    const Vector3 hips_W = (at(Point::kHipL) + at(Point::kHipR)) / 2;
    seat_ = Around(hips_W, kThings.seat_share * sizes.Stature());
    seat_top_mm_ = hips_W.z() + kThings.above_hips_mm;
  }
  constexpr std::array kForearms = {std::pair{Point::kElbowL, Point::kFingertipsL},
                                    std::pair{Point::kElbowR, Point::kFingertipsR}};
  for (int i = 0; i < 2; ++i) {
    const Vector3 hand_W = at(kForearms[i].second);
    if (Slope(at(kForearms[i].first), hand_W) > -kThings.upright) continue;
    const Vector3 end_W = hand_W - Vector3(0, 0, kThings.bag_share * sizes.Stature());
    bags_[i] = PosedCapsule(hand_W, end_W, kThings.bag_mm, kThings.bag_mm);
  }
}

bool ThingPlaces::IsOnHead(const Contact& contact) const {
  const auto distance = head_.DistanceTo(contact.from_W, contact.to_W);
  return distance.outside_mm < 0 && (distance.segment_W - chin_W_).dot(up_W_) > 0;
}

bool ThingPlaces::IsOnBack(const Contact& contact) const {
  const auto distance = back_.DistanceTo(contact.from_W, contact.to_W);
  const Vector3 offset_T = X_WT_.R.transpose() * (distance.segment_W - distance.core_W);
  return distance.outside_mm < 0 && offset_T.x() < -behind_mm_ &&
         std::abs(offset_T.y()) < beside_mm_;
}

bool ThingPlaces::IsOfSeat(const Contact& contact) const {
  if (!seat_) return false;
  const auto distance = seat_->DistanceTo(contact.from_W, contact.to_W);
  return distance.outside_mm < 0 && distance.segment_W.z() < seat_top_mm_;
}

bool ThingPlaces::IsOfBag(const Contact& contact) const {
  return std::ranges::any_of(bags_, [&](const auto& bag) { return bag && Reaches(*bag, contact); });
}

std::optional<Thing> ThingPlaces::At(const Contact& contact) const {
  if (Allows(Thing::kHat) && IsOnHead(contact)) return Thing::kHat;
  if (Allows(Thing::kPack) && IsOnBack(contact)) return Thing::kPack;
  if (Allows(Thing::kSeat) && IsOfSeat(contact)) return Thing::kSeat;
  if (Allows(Thing::kBag) && IsOfBag(contact)) return Thing::kBag;
  return std::nullopt;
}

}  // namespace mocap

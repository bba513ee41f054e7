#include "core/objective/carried_things.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mocap {
namespace {

// Sizes of things, from the middle of the skull, from the spine, and around a hanging bag.
constexpr double kHatMm = 200;
constexpr double kPackMm = 280;
constexpr double kPackBesideMm = 30;
constexpr double kBagMm = 150;
// As shares of the stature: a wheel's far end from the hips, and a bag's from the hand.
constexpr double kSeatShare = 0.35;
constexpr double kBagShare = 0.25;
// Armrests and wheels rise above the hip joints.
constexpr double kAboveHipsMm = 100;
// A thigh is level with a smaller slope; a trunk is upright and a forearm hangs with a greater one.
constexpr double kLevelSlope = 0.6;
constexpr double kUprightSlope = 0.7;
// Middle of the skull, and the lower border of hair, from the head's centre as shares of its size.
constexpr double kSkullShare = 0.25;

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
  chin_W_ = at(Point::kHead) - kSkullShare * sizes.head * up_W_;
  head_ = Around(at(Point::kHead) + kSkullShare * sizes.head * up_W_, kHatMm);
  back_ = PosedCapsule(X_WT_ * Vector3(0, 0, -sizes.torso / 4),
                       X_WT_ * Vector3(0, 0, sizes.torso / 2), kPackMm, kPackMm);
  behind_mm_ = 0.4 * sizes.torso_depth;
  beside_mm_ = sizes.torso_width / 2 + kPackBesideMm;
  const auto is_level = [&](Point hip, Point knee) {
    return std::abs(Slope(at(hip), at(knee))) < kLevelSlope;
  };
  if (X_WT_.R(2, 2) > kUprightSlope && is_level(Point::kHipL, Point::kKneeL) &&
      is_level(Point::kHipR, Point::kKneeR)) {
    const Vector3 hips_W = (at(Point::kHipL) + at(Point::kHipR)) / 2;
    seat_ = Around(hips_W, kSeatShare * sizes.Stature());
    seat_top_mm_ = hips_W.z() + kAboveHipsMm;
  }
  constexpr std::array kForearms = {std::pair{Point::kElbowL, Point::kFingertipsL},
                                    std::pair{Point::kElbowR, Point::kFingertipsR}};
  for (int i = 0; i < 2; ++i) {
    const Vector3 hand_W = at(kForearms[i].second);
    if (Slope(at(kForearms[i].first), hand_W) > -kUprightSlope) continue;
    const Vector3 end_W = hand_W - Vector3(0, 0, kBagShare * sizes.Stature());
    bags_[i] = PosedCapsule(hand_W, end_W, kBagMm, kBagMm);
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

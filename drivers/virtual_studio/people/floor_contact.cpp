#include "drivers/virtual_studio/people/floor_contact.h"

#include <algorithm>
#include <span>

namespace mocap::simulation {
namespace {

/// Whether one of these points of a bone stands.
bool Stands(std::span<const Vector3> sole, const RigidTransform& bone, const RigidTransform& later,
            double apart_s) {
  return std::ranges::any_of(sole, [&](const Vector3& p) {
    const Vector3 p_W = bone * p;
    const double speed_mm_s = (later * p - p_W).norm() / apart_s;
    return p_W.z() <= kContactHeight_mm && speed_mm_s <= kContactSpeed_mm_s;
  });
}

}  // namespace

FloorContacts ContactsOf(const Anthropometry& body, const BonePoses& bones, const BonePoses& later,
                         double apart_s) {
  const double toes_mm = body.foot_mm - body.heel_mm - body.ball_mm;
  const double toes_to_sole_mm = kToeHeight * body.stature_mm;
  const std::array<Vector3, 2> heel = {Vector3(-body.heel_mm, 0, -body.ankle_to_sole_mm),
                                       Vector3(-body.heel_mm / 2, 0, -body.ankle_to_sole_mm)};
  const std::array<Vector3, 3> forefoot = {Vector3(0, 0, -toes_to_sole_mm),
                                           Vector3(toes_mm / 2, 0, -toes_to_sole_mm),
                                           Vector3(toes_mm, 0, -toes_to_sole_mm)};
  FloorContacts contacts;
  for (const int side : {kLeft, kRight}) {
    const int foot = kFootL + side, toes = kToesL + side;
    contacts[side] = Stands(heel, bones[foot], later[foot], apart_s);
    contacts[2 + side] = Stands(forefoot, bones[toes], later[toes], apart_s);
  }
  return contacts;
}

}  // namespace mocap::simulation

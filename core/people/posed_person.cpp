#include "core/people/posed_person.h"

namespace mocap {

void PosePerson(const BodyModel& body, const PoseState& pose, double reach_mm, double handicap_mm,
                PosedPerson& person) {
  body.PoseShape(body.PostureAt(pose), person.capsules);
  person.reach_mm = reach_mm;
  person.handicap_mm = handicap_mm;
  person.box_W.setEmpty();
  for (const PosedCapsule& capsule : person.capsules) {
    const Vector3 a = Vector3::Constant(capsule.radius_a_mm + reach_mm);
    const Vector3 b = Vector3::Constant(capsule.radius_b_mm + reach_mm);
    person.box_W.extend(Eigen::AlignedBox3d(capsule.a_W - a, capsule.a_W + a));
    person.box_W.extend(Eigen::AlignedBox3d(capsule.b_W - b, capsule.b_W + b));
  }
}

}  // namespace mocap

#include "core/people/posed_person.h"

#include <algorithm>

#include "core/evidence/evidence.h"

namespace mocap {

void PosePerson(const BodyModel& body, const PoseState& pose, double reach_mm,
                PosedPerson& person) {
  body.PoseShape(body.PostureAt(pose), person.capsules);
  person.reach_mm = reach_mm;
  person.box_W.setEmpty();
  for (const PosedCapsule& capsule : person.capsules) {
    const Vector3 a = Vector3::Constant(capsule.radius_a_mm + reach_mm);
    const Vector3 b = Vector3::Constant(capsule.radius_b_mm + reach_mm);
    person.box_W.extend(Eigen::AlignedBox3d(capsule.a_W - a, capsule.a_W + a));
    person.box_W.extend(Eigen::AlignedBox3d(capsule.b_W - b, capsule.b_W + b));
  }
}

double DistanceTo(const PosedPerson& person, const Vector3& p_W, double enough_mm) {
  double least_mm = person.reach_mm;
  for (const PosedCapsule& capsule : person.capsules) {
    const double from_middle_mm = least_mm + capsule.reach_mm;
    if ((p_W - capsule.middle_W).squaredNorm() >= from_middle_mm * from_middle_mm) continue;
    least_mm = std::min(least_mm, capsule.DistanceTo(p_W).outside_mm);
    if (least_mm < enough_mm) break;
  }
  return least_mm;
}

const VoxelGrid& BelieveWithin(std::span<const PosedPerson> people, const Observation& room,
                               VoxelGrid& believed) {
  if (room.doubtful.empty() || people.empty()) return room.flesh;
  believed = room.flesh;
  for (const Eigen::Vector3i& cell : room.doubtful) {
    const Vector3 p_W = believed.CenterOf(cell.x(), cell.y(), cell.z());
    const bool is_believed = std::ranges::any_of(people, [&](const PosedPerson& person) {
      return !person.is_lost && person.box_W.contains(p_W) && DistanceTo(person, p_W, 0) <= 0;
    });
    if (is_believed) believed.Set(cell.x(), cell.y(), cell.z());
  }
  return believed;
}

Eigen::AlignedBox3d AroundStranger(const Eigen::AlignedBox3d& flesh_W) {
  constexpr double kStrideMm = 400;
  return DownToFloor(flesh_W, LacksLegs(flesh_W.min().z()) ? kStrideMm : kAsideMm);
}

Eigen::AlignedBox3d DownToFloor(const Eigen::AlignedBox3d& flesh_W, double beside_mm) {
  const Vector3 beside = Vector3::Constant(beside_mm);
  Eigen::AlignedBox3d box_W(flesh_W.min() - beside, flesh_W.max() + beside);
  box_W.min().z() = std::min(box_W.min().z(), 0.0);
  return box_W;
}

}  // namespace mocap

#include "core/people/posed_person.h"

#include <algorithm>

#include "core/evidence/evidence.h"

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

void AddCellsWithin(const PosedPerson& person, std::span<const Eigen::Vector3i> cells,
                    VoxelGrid& flesh) {
  const auto is_within = [&](const Vector3& p_W) {
    return std::ranges::any_of(person.capsules, [&](const PosedCapsule& capsule) {
      const bool is_near = (p_W - capsule.middle_W).norm() <= capsule.reach_mm;
      return is_near && capsule.DistanceTo(p_W).outside_mm <= 0;
    });
  };
  for (const Eigen::Vector3i& cell : cells) {
    const Vector3 middle_W = flesh.CenterOf(cell.x(), cell.y(), cell.z());
    if (person.box_W.contains(middle_W) && is_within(middle_W))
      flesh.Set(cell.x(), cell.y(), cell.z());
  }
}

Eigen::AlignedBox3d AroundStranger(const Eigen::AlignedBox3d& flesh_W) {
  constexpr double kBesideMm = 100, kStrideMm = 400;
  return DownToFloor(flesh_W, LacksLegs(flesh_W.min().z()) ? kStrideMm : kBesideMm);
}

Eigen::AlignedBox3d DownToFloor(const Eigen::AlignedBox3d& flesh_W, double beside_mm) {
  const Vector3 beside = Vector3::Constant(beside_mm);
  Eigen::AlignedBox3d box_W(flesh_W.min() - beside, flesh_W.max() + beside);
  box_W.min().z() = std::min(box_W.min().z(), 0.0);
  return box_W;
}

}  // namespace mocap

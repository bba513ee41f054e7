#include "drivers/virtual_studio/truth.h"

#include "drivers/virtual_studio/scene.h"

namespace mocap {

SimulatedTruth::SimulatedTruth(const SimulatedStudioOptions& options)
    : people_(simulation::MakePeople(options)) {}
SimulatedTruth::~SimulatedTruth() = default;
SimulatedTruth::SimulatedTruth(SimulatedTruth&&) noexcept = default;

JointPositions SimulatedTruth::At(std::int64_t capture_ns, int person) const {
  return simulation::PointsOf(people_[person].body(), people_[person].BonesAt(capture_ns));
}

simulation::FloorContacts SimulatedTruth::ContactsAt(std::int64_t capture_ns, int person) const {
  // So short that a foot hardly changes its speed.
  constexpr std::int64_t kApart_ns = 1'000'000;
  const simulation::Person& who = people_[person];
  return simulation::ContactsOf(who.body(), who.BonesAt(capture_ns),
                                who.BonesAt(capture_ns + kApart_ns), 1e-9 * kApart_ns);
}

SegmentRotations SimulatedTruth::RotationsAt(std::int64_t capture_ns, int person) const {
  const simulation::BonePoses bones = people_[person].BonesAt(capture_ns);
  return {bones[simulation::kHead].R, bones[simulation::kHandL].R, bones[simulation::kHandR].R};
}

TruthSizes SimulatedTruth::Sizes(int person) const {
  const simulation::Anthropometry& body = people_[person].body();
  const JointPositions upright =
      simulation::PointsOf(body, simulation::PlaceBones(body, simulation::BodyPose{}));
  const auto neck = static_cast<int>(simulation::TruthPoint::kNeck);
  return {body.stature_mm,
          body.ankle_to_sole_mm,
          {{"torso_mm", upright[neck].norm()},
           {"thigh_mm", body.thigh_mm},
           {"calf_mm", body.calf_mm()},
           {"upper_arm_mm", body.upper_arm_mm},
           {"lower_arm_mm", body.lower_arm_mm()}}};
}

}  // namespace mocap

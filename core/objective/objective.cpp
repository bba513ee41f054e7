#include "core/objective/objective.h"

namespace mocap {
namespace {

// Of poses of varied simulated people within 70 mm of the truth, one in a hundred has a greater
// misfit than the first. Somebody who is tracked may be covered.
constexpr double kCredible = 0.33, kLost = 0.5;
// What else an evaluation costs, as a number of contacts.
constexpr int kAlways = 150;

}  // namespace

bool Fitness::IsCredible() const { return misfit < kCredible; }
bool Fitness::IsLost() const { return misfit > kLost; }

void Objective::SetEvidence(const Evidence& evidence) {
  evidence_ = &evidence;
  whole_.contacts.SetEvidence(evidence, options_.voxels, options_.rays, options_.pose_std_mm);
  borders_.SetEvidence(evidence, options_.pose_std_mm);
  flesh_.SetEvidence(evidence, whole_.contacts.contacts(), options_.pose_std_mm);
  keypoints_.SetEvidence(evidence.keypoints);
}

Fitness Objective::At(const BodyModel& body, const PoseState& pose, const Things& things) {
  whole_.posed.Set(body, pose);
  return At(whole_, things);
}

Fitness Objective::At(ComparedBody& part, const Things& things) {
  Count(part.contacts);
  const PosedBody& posed = part.posed;
  const BodyModel& body = posed.body();
  const ContactNats contacts = part.contacts.At(posed, things);
  Fitness fitness;
  fitness[Term::kRays] = contacts.rays;
  fitness[Term::kSurface] = contacts.surface;
  fitness[Term::kThings] = contacts.things + (body.sizes().IsDraped() ? kThingNats : 0);
  fitness[Term::kBorders] = borders_.At(posed, part.moving);
  fitness[Term::kFlesh] = flesh_.At(posed, part.moving & ~part.contacts.CarvedAway());
  fitness[Term::kOverlap] = OverlapTerm{}.At(posed, part.moving, part.present);
  fitness[Term::kFloor] = floor_.At(posed, part.moving);
  fitness[Term::kJoints] = JointNats(body.table(), posed.pose().theta);
  fitness[Term::kHabits] = HabitNats(body, posed.pose(), evidence_->toes_W);
  fitness[Term::kKeypoints] = keypoints_.At(posed);
  fitness.backwards = ShareBackwards(posed.pose(), evidence_->toes_W);
  fitness.things = contacts.shown;
  fitness.unexplained_share = contacts.unexplained_share;
  fitness.misfit = contacts.misfit;
  fitness.surface_mm = contacts.surface_mm;
  return fitness;
}

void Objective::Linearize(const BodyModel& body, const PoseState& pose, const Things& things,
                          UpdateEquations& equations) {
  whole_.posed.Set(body, pose);
  Linearize(whole_, things, equations);
}

void Objective::Linearize(ComparedBody& part, const Things& things, UpdateEquations& equations) {
  Count(part.contacts);
  const PosedBody& posed = part.posed;
  chain_.Reset(posed.body().table(), posed.posture());
  Linearisation sums{chain_, equations};
  part.contacts.Linearize(posed, things, sums);
  borders_.Linearize(posed, part.moving, sums);
  flesh_.Linearize(posed, part.moving & ~part.contacts.CarvedAway(), sums);
  floor_.Linearize(posed, part.moving, sums);
  keypoints_.Linearize(posed, sums);
  chain_.AddTo(equations);
  OverlapTerm{}.Linearize(posed, part.moving, part.present, sums);
  LinearizeJoints(posed.body().table(), posed.pose(), equations);
}

const std::vector<SurfaceResidual>& Objective::ResidualsAt(const BodyModel& body,
                                                           const PoseState& pose) {
  whole_.posed.Set(body, pose);
  Count(whole_.contacts);
  residuals_.clear();
  const auto add = [&](SurfaceResidual residual, const Vector3& p_W) {
    // Equivalent to a moving contact with a fixed body.
    body.DirectionalJacobian(whole_.posed.posture(), whole_.posed.CarrierOf(residual.capsule), p_W,
                             residual.normal_W, residual.J_outside_by_step);
    residuals_.push_back(std::move(residual));
  };
  whole_.contacts.ForEach(whole_.posed, [&](const ContactTerm::Residual& r, const Contact&) {
    if (r.capsule < 0) return;
    add({r.is_ray ? ResidualKind::kRay : ResidualKind::kSurface,
         r.capsule,
         r.share,
         r.normal_W,
         r.outside_mm,
         whole_.contacts.NoiseOf(r.is_ray).VarianceAt(r.outside_mm),
         {}},
        r.p_W);
  });
  borders_.ForEach(whole_.posed, whole_.moving,
                   [&](int i, double share, const Vector3& p_W, const Protrusion& p) {
                     add({ResidualKind::kBorder,
                          i,
                          share,
                          p.outward_W,
                          -p.depth_mm,
                          borders_.noise().VarianceAt(-p.depth_mm),
                          {}},
                         p_W);
                   });
  return residuals_;
}

void Objective::Count(const ContactTerm& contacts) {
  constexpr ObjectiveOptions kWhole;
  evaluations_ += static_cast<double>(contacts.contacts().size() + kAlways) /
                  (kWhole.voxels + kWhole.rays + kAlways);
}

}  // namespace mocap

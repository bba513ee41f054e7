#include "core/objective/objective.h"

namespace mocap {
namespace {

// Of poses of varied simulated people within 70 mm of the truth, one in a hundred has a greater
// misfit than the first. Somebody who is tracked may be covered.
constexpr double kCredible = 0.33, kLost = 0.5;
// What else an evaluation costs, as a number of contacts.
constexpr int kAlways = 150;
constexpr CapsuleSet kAll = ~CapsuleSet{0};

}  // namespace

bool Fitness::IsCredible() const { return misfit < kCredible; }
bool Fitness::IsLost() const { return misfit > kLost; }

void Objective::SetEvidence(const Evidence& evidence, const Heading& heading) {
  heading_ = heading;
  contacts_.SetEvidence(evidence, options_.voxels, options_.rays, options_.pose_std_mm);
  borders_.SetEvidence(evidence, options_.pose_std_mm);
  flesh_.SetEvidence(evidence, contacts_.contacts(), options_.pose_std_mm);
}

Fitness Objective::At(const BodyModel& body, const PoseState& pose, const Things& things) {
  Count(static_cast<int>(contacts_.contacts().size()));
  posed_.Set(body, pose);
  const ContactNats contacts = contacts_.At(posed_, things);
  Fitness fitness;
  fitness[Term::kRays] = contacts.rays;
  fitness[Term::kSurface] = contacts.surface;
  fitness[Term::kThings] = contacts.things + (body.sizes().IsDraped() ? kThingNats : 0);
  fitness[Term::kBorders] = borders_.At(posed_, kAll);
  fitness[Term::kFlesh] = flesh_.At(posed_, ~contacts_.CarvedAway());
  fitness[Term::kOverlap] = OverlapTerm{}.At(posed_, kAll, kAll);
  fitness[Term::kJoints] = JointNats(body.table(), pose.theta);
  fitness[Term::kHabits] = HabitNats(body, pose, heading_);
  fitness.backwards = ShareBackwards(pose, heading_);
  fitness.things = contacts.shown;
  fitness.unexplained_share = contacts.unexplained_share;
  fitness.misfit = contacts.misfit;
  fitness.surface_mm = contacts.surface_mm;
  return fitness;
}

void Objective::Linearize(const BodyModel& body, const PoseState& pose, const Things& things,
                          UpdateEquations& equations) {
  Count(static_cast<int>(contacts_.contacts().size()));
  posed_.Set(body, pose);
  chain_.Reset(body.table(), posed_.posture());
  Linearisation sums{chain_, equations};
  contacts_.Linearize(posed_, things, sums);
  borders_.Linearize(posed_, kAll, sums);
  flesh_.Linearize(posed_, ~contacts_.CarvedAway(), sums);
  chain_.AddTo(equations);
  OverlapTerm{}.Linearize(posed_, kAll, kAll, sums);
  LinearizeJoints(body.table(), pose, equations);
}

const std::vector<SurfaceResidual>& Objective::ResidualsAt(const BodyModel& body,
                                                           const PoseState& pose) {
  Count(static_cast<int>(contacts_.contacts().size()));
  posed_.Set(body, pose);
  residuals_.clear();
  const auto add = [&](SurfaceResidual residual, const Vector3& p_W) {
    // Equivalent to a moving contact with a fixed body.
    body.DirectionalJacobian(posed_.posture(), posed_.CarrierOf(residual.capsule), p_W,
                             residual.normal_W, residual.J_outside_by_step);
    residuals_.push_back(std::move(residual));
  };
  contacts_.ForEach(posed_, [&](const ContactTerm::Residual& r, const Contact&) {
    if (r.capsule < 0) return;
    add({r.is_ray ? ResidualKind::kRay : ResidualKind::kSurface,
         r.capsule,
         r.share,
         r.normal_W,
         r.outside_mm,
         contacts_.NoiseOf(r.is_ray).VarianceAt(r.outside_mm),
         {}},
        r.p_W);
  });
  borders_.ForEach(posed_, kAll, [&](int i, double share, const Vector3& p_W, const Protrusion& p) {
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

void Objective::Count(int contacts) {
  constexpr ObjectiveOptions kWhole;
  evaluations_ += static_cast<double>(contacts + kAlways) / (kWhole.voxels + kWhole.rays + kAlways);
}

}  // namespace mocap

#include "core/hypotheses/hypothesis.h"

namespace mocap {
namespace {

// How closely a body starts at the pose that was found for it.
struct Start {
  double std_mm = 50, std_rad = 0.3;
  int size_iterations = 3;
};
constexpr Start kStart{};

}  // namespace

Hypothesis::Hypothesis(const BodyModel& model, const PoseState& pose, bool measures)
    : body(model), filter(MotionNoise{}) {
  filter.Reset(pose, kStart.std_mm, kStart.std_rad);
  if (measures) sizes.emplace(body);
}

void Hypothesis::Fit(Objective& objective) {
  filter.Update(
      [&](const PoseState& pose, UpdateEquations& equations) {
        objective.Linearize(body, pose, things, equations);
      },
      Iterations{});
  fitness = objective.At(body, filter.pose(), things);
  // A thing that the frame does not show is dropped and does not come back.
  things = fitness.things;
}

void Hypothesis::Jump(Objective& objective, const PoseState& pose) {
  filter.Jump(pose);
  Fit(objective);
}

void Hypothesis::MeasureSizes(Objective& objective) {
  const SizeRefiner without_frame = *sizes;
  for (int i = 0; i < kStart.size_iterations; ++i) {
    sizes = without_frame;
    RefineSizes(objective);
    // The same evidence again adds no information to the filter.
    DrawNear(objective, body, things, Iterations{}, filter);
    fitness = objective.At(body, filter.pose(), things);
  }
}

void Hypothesis::RefineSizes(Objective& objective) {
  sizes->Add(body, objective, filter.pose());
  body.Resize(sizes->Sizes());
}

void DrawNear(Objective& objective, const BodyModel& body, const Things& things,
              const Iterations& iterations, PoseFilter& filter) {
  filter.Draw(
      [&](const PoseState& pose, UpdateEquations& equations) {
        objective.Linearize(body, pose, things, equations);
      },
      iterations);
}

double MeanDistance(const BodyModel& a, const PoseState& pose_a, const BodyModel& b,
                    const PoseState& pose_b) {
  const BodyPoints apart_W = a.PointsAt(a.PostureAt(pose_a)) - b.PointsAt(b.PostureAt(pose_b));
  return apart_W.colwise().norm().mean();
}

}  // namespace mocap

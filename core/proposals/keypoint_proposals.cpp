#include "core/proposals/keypoint_proposals.h"

#include <array>
#include <numbers>

#include "core/body/stance.h"
#include "core/objective/keypoint_term.h"
#include "core/objective/pose_priors.h"

namespace mocap {
namespace {

// Limbs, and the whole body, may be this far from where the fit begins.
constexpr double kSpread_mm = 200, kSpread_rad = 1;
constexpr Iterations kIterations{8, 8};
// Graduated non-convexity (Blake and Zisserman 1987): factors of the noise, one fit after the
// other.
constexpr std::array<double, 4> kWidths = {16, 6, 2.5, 1};

void FitToKeypoints(const BodyModel& body, std::span<const KeypointRays> views, double width,
                    PoseFilter& filter) {
  PosedBody posed;
  ChainEquations chain;
  filter.Draw(
      [&](const PoseState& pose, UpdateEquations& equations) {
        posed.Set(body, pose);
        chain.Reset(body.table(), posed.posture());
        Linearisation sums{chain, equations};
        for (const KeypointRays& view : views) KeypointTerm::PullAsRight(view, width, posed, sums);
        chain.AddTo(equations);
        LinearizeJoints(body.table(), pose, equations);
      },
      kIterations);
}

// The trunk as it is, and turned about each of its axes: facing the other way, or head down. Which
// way the limbs are is not known after a turn.
std::array<PoseState, 4> StartsFrom(const BodyModel& body, const PoseState& pose) {
  std::array<PoseState, 4> starts = {pose, pose, pose, pose};
  for (int axis = 0; axis < 3; ++axis) {
    PoseState& turned = starts[static_cast<std::size_t>(axis) + 1];
    turned.X_WT.R = pose.X_WT.R * ExpRotation(std::numbers::pi * Vector3::Unit(axis));
    turned.theta = AnglesOf({}, body.table());
  }
  return starts;
}

double NatsAt(const BodyModel& body, const PoseState& pose, std::span<const KeypointRays> views) {
  PosedBody posed;
  posed.Set(body, pose);
  double nats = 0;
  for (const KeypointRays& view : views) nats += KeypointTerm::NatsOf(view, posed);
  return nats;
}

}  // namespace

std::optional<PoseState> ProposeByKeypoints(Objective& objective, const Hypothesis& present,
                                            std::span<const KeypointRays> views) {
  const BodyModel& body = present.body;
  PoseFilter filter{MotionNoise{}};
  std::optional<PoseState> best;
  double least = NatsAt(body, present.filter.pose(), views);
  for (const PoseState& start : StartsFrom(body, present.filter.pose())) {
    filter.Reset(start, kSpread_mm, kSpread_rad);
    for (const double width : kWidths) FitToKeypoints(body, views, width, filter);
    const double nats = NatsAt(body, filter.pose(), views);
    if (!filter.is_sound() || !(nats < least)) continue;
    least = nats;
    best = filter.pose();
  }
  if (!best) return std::nullopt;
  filter.Jump(*best);
  DrawNear(objective, body, present.things, {}, filter);
  return filter.is_sound() ? std::optional(filter.pose()) : std::nullopt;
}

}  // namespace mocap

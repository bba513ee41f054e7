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
// The keypoints' fit leaves limbs this far from the evidence.
constexpr double kLeft_mm = 50, kLeft_rad = 0.3;

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

// Which way the limbs are is not known after a turn.
PoseState TurnedAbout(const BodyModel& body, PoseState pose) {
  pose.X_WT.R = ExpRotation(std::numbers::pi * Vector3::UnitZ()) * pose.X_WT.R;
  pose.theta = AnglesOf({}, body.table());
  return pose;
}

}  // namespace

void ProposeByKeypoints(Objective& objective, const Hypothesis& present,
                        std::span<const KeypointRays> views, std::vector<PoseState>& poses) {
  const BodyModel& body = present.body;
  const PoseState& pose = present.filter.pose();
  for (const PoseState& start : {pose, TurnedAbout(body, pose)}) {
    PoseFilter filter{MotionNoise{}};
    filter.Reset(start, kSpread_mm, kSpread_rad);
    for (const double width : kWidths) FitToKeypoints(body, views, width, filter);
    if (!filter.is_sound()) continue;
    filter.Reset(filter.pose(), kLeft_mm, kLeft_rad);
    DrawNear(objective, body, present.things, {}, filter);
    if (filter.is_sound()) poses.push_back(filter.pose());
  }
}

}  // namespace mocap

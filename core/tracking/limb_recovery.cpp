#include "core/tracking/limb_recovery.h"

#include <array>
#include <vector>

#include "core/body/stance.h"
#include "core/tracking/pose_filter.h"

namespace mocap {
namespace {

constexpr double kUnexplainedShare = 0.02;
constexpr double kBetterMm = 1.0;
constexpr int kIterations = 4;
constexpr int kRestFrames = 3;
constexpr std::array<Segment, 4> kLimbEnds = {Segment::kLowerArmL, Segment::kLowerArmR,
                                              Segment::kCalfL, Segment::kCalfR};

std::vector<Stance> Stances(Segment limb_end) {
  std::vector<Stance> stances;
  if (limb_end == Segment::kLowerArmL || limb_end == Segment::kLowerArmR) {
    for (const double raise : {-85.0, -35.0, 20.0, 75.0}) {
      for (const double forward : {-25.0, 50.0}) {
        for (const double elbow : {15.0, 95.0}) {
          stances.push_back({.raise_l = raise,
                             .raise_r = raise,
                             .forward_l = forward,
                             .forward_r = forward,
                             .elbow_l = elbow,
                             .elbow_r = elbow});
        }
      }
    }
    return stances;
  }
  for (const double hip : {-60.0, -15.0, 30.0, 85.0}) {
    for (const double knee : {10.0, 80.0}) {
      stances.push_back({.hip_l = hip, .hip_r = hip, .knee_l = knee, .knee_r = knee});
    }
  }
  return stances;
}

// Rows of the axes that move this limb and nothing of the trunk.
std::vector<int> JointsOf(const BodyTable& table, Segment limb_end) {
  std::vector<int> rows;
  const int trunk = table.carrier[static_cast<int>(Segment::kPelvis)];
  for (int i = table.carrier[static_cast<int>(limb_end)]; i >= 0 && i != trunk;
       i = table.joints[i].parent) {
    rows.push_back(i);
  }
  return rows;
}

SurfaceFitOptions CoarseOptions() {
  SurfaceFitOptions options;
  options.samples = 300;
  return options;
}

}  // namespace

LimbRecovery::LimbRecovery() : fit_(CoarseOptions()) {}

std::optional<PoseState> LimbRecovery::Recover(const BodyModel& body, const VoxelCloud& cloud,
                                               const PoseState& pose) {
  if (resting_ > 0) {
    --resting_;
    return std::nullopt;
  }
  fit_.SetVoxels(cloud);
  const SurfaceFitQuality before = fit_.QualityAt(body, pose);
  if (before.unexplained_share < kUnexplainedShare) return std::nullopt;

  std::optional<PoseState> best;
  double best_cost = before.Cost() - kBetterMm;
  for (const Segment limb_end : kLimbEnds) {
    const std::vector<int> rows = JointsOf(body.table(), limb_end);
    for (const Stance& stance : Stances(limb_end)) {
      const JointAngles angles = AnglesOf(stance, body.table());
      PoseState guess = pose;
      for (const int row : rows) guess.theta[row] = angles[row];
      PoseFilter filter{MotionNoise{}};
      filter.Reset(guess, 15, 0.4);
      filter.Update(
          body.table(),
          [&](const PoseState& at, UpdateEquations& equations) {
            fit_.Linearize(body, at, equations);
          },
          kIterations);
      const double cost = fit_.QualityAt(body, filter.pose()).Cost();
      if (cost >= best_cost) continue;
      best_cost = cost;
      best = filter.pose();
    }
  }
  if (!best) resting_ = kRestFrames;
  return best;
}

}  // namespace mocap

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"
#include "drivers/virtual_studio/truth.h"
#include "tools/gait/gait_analysis.h"

namespace mocap {
namespace {

constexpr double kFps = 30;

/// The true points of a simulated person, as a tracker would give them.
Result TrueResult(const std::string& motion, double seconds) {
  SimulatedStudioOptions options = RecordedSimulation();
  options.motion = motion;
  const SimulatedTruth truth(options);
  Result result;
  const auto at = [](const JointPositions& joints, std::string_view name) -> Vector3 {
    const auto joint = std::ranges::find(kSimulatedJointNames, name);
    return joints[static_cast<std::size_t>(joint - kSimulatedJointNames.begin())];
  };
  for (int i = 0; i < seconds * kFps; ++i) {
    PoseRow& row = result.poses.emplace_back();
    row.frame = i;
    row.timestamp_ns = options.start_ns + std::llround(i * 1e9 / kFps);
    row.state = CaptureState::kTracking;
    row.has_pose = true;
    const JointPositions joints = truth.At(row.timestamp_ns);
    for (const Point point : {Point::kHipL, Point::kHipR})
      row.points_W.col(static_cast<int>(point)) = at(joints, kPointNames[static_cast<int>(point)]);
    for (int k = 0; k < kFurtherPointCount; ++k)
      if (!kFurtherPointNames[k].starts_with("clavicle"))
        row.further_W.col(k) = at(joints, kFurtherPointNames[k]);
  }
  return result;
}

/// The simulated walker takes a step in this time, left foot first (motions/gait.h).
constexpr double kStep_s = 0.53;

TEST(Gait, FeetStrikeWhenTheSimulatedOnesDo) {
  const Result walk = TrueResult("walk", 10);
  const std::vector<GaitRun> runs = GaitRunsOf(walk);
  ASSERT_EQ(runs.size(), 1u);
  int strikes = 0;
  for (const GaitEvent& event : FindGaitEvents(runs.front())) {
    if (event.kind != GaitEventKind::kFootStrike) continue;
    const double cycles = event.time_s / (2 * kStep_s) - (event.side == Side::kLeft ? 0 : 0.5);
    EXPECT_NEAR(cycles, std::round(cycles), 0.033 / (2 * kStep_s)) << event.time_s;
    ++strikes;
  }
  EXPECT_NEAR(strikes, 10 / kStep_s, 2);
}

TEST(Gait, SidesTakeTurns) {
  const std::vector<GaitRun> runs = GaitRunsOf(TrueResult("walk", 10));
  Side last = Side::kLeft;
  bool is_first = true;
  for (const GaitEvent& event : FindGaitEvents(runs.front())) {
    if (event.kind != GaitEventKind::kFootStrike) continue;
    if (!is_first) {
      EXPECT_NE(event.side, last) << event.time_s;
    }
    last = event.side;
    is_first = false;
  }
}

TEST(Gait, StepsAreAsLongAsThePathDividedByThem) {
  const GaitAnalysis gait = AnalyseGait(TrueResult("walk", 10));
  ASSERT_GT(gait.strides.size(), 10u);
  for (const auto& side : gait.summary.figures) {
    // 1.08 m/s along the path; the feet take the outer and the inner curve.
    EXPECT_NEAR(side[0].mean, 1080 * kStep_s, 0.15 * 1080 * kStep_s);
    EXPECT_NEAR(side[4].mean, 2 * kStep_s, 0.02 * 2 * kStep_s);
    EXPECT_NEAR(side[5].mean, 60 / kStep_s, 0.02 * 60 / kStep_s);
  }
}

TEST(Gait, SharesOfACycleAddUp) {
  for (const Stride& stride : AnalyseGait(TrueResult("walk", 10)).strides) {
    const double stance = kGaitFigures[7].of(stride), swing = kGaitFigures[8].of(stride);
    const double both = kGaitFigures[9].of(stride), single = kGaitFigures[10].of(stride);
    EXPECT_NEAR(stance + swing, 100, 1e-9);
    EXPECT_NEAR(both + single, stance, 1e-9);
  }
}

TEST(Gait, WhoStandsTakesNoStep) {
  const GaitAnalysis gait = AnalyseGait(TrueResult("stand", 10));
  EXPECT_TRUE(gait.events.empty());
  EXPECT_TRUE(gait.strides.empty());
  EXPECT_NE(GaitText(gait).find("no whole stride"), std::string::npos);
}

TEST(Gait, AGapEndsARun) {
  Result walk = TrueResult("walk", 10);
  walk.poses.erase(walk.poses.begin() + 140, walk.poses.begin() + 160);
  EXPECT_EQ(GaitRunsOf(walk).size(), 2u);
}

TEST(Gait, PosesWithoutFeetAreRefused) {
  Result walk = TrueResult("walk", 1);
  for (PoseRow& row : walk.poses) row.further_W.setConstant(std::nan(""));
  EXPECT_THROW(AnalyseGait(walk), SetupError);
}

TEST(Gait, ACurveHasTheMeanAndSpreadOfItsStrides) {
  std::vector<BodyAngles> angles(61);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    angles[i].time_ns = static_cast<std::int64_t>(i) * 50'000'000;
    angles[i].leg_l.bend = i < 21 ? 0.1 : 0.3;
  }
  std::vector<Stride> strides(2);
  strides[0] = {.side = Side::kLeft, .begin_s = 0, .end_s = 1};
  strides[1] = {.side = Side::kLeft, .begin_s = 2, .end_s = 3};
  const std::vector<CycleCurve> curves = CurvesOf(angles, 0, strides);
  const auto knee = std::ranges::find(curves, "knee_angle_l", &CycleCurve::angle);
  ASSERT_NE(knee, curves.end());
  constexpr double kDegreesPerRad = 57.29577951308232;
  EXPECT_EQ(knee->strides, 2);
  EXPECT_NEAR(knee->mean_deg[50], 0.2 * kDegreesPerRad, 1e-9);
  EXPECT_NEAR(knee->spread_deg[50], std::sqrt(0.02) * kDegreesPerRad, 1e-9);
  for (const CycleCurve& curve : curves) EXPECT_FALSE(curve.angle.ends_with("_r")) << curve.angle;
}

}  // namespace
}  // namespace mocap

#include <gtest/gtest.h>

#include <cmath>

#include "core/degrees.h"
#include "core/errors.h"
#include "drivers/virtual_studio/truth.h"
#include "tools/gait/gait_analysis.h"
#include "tools/gait/gait_report.h"
#include "tools/gait/gait_text.h"

namespace mocap {
namespace {

constexpr double kFps = 30;

/// The true points and contacts of a simulated person, as a tracker would give them.
Result TrueResult(const std::string& motion, double seconds, double fps = kFps) {
  SimulatedStudioOptions options = RecordedSimulation();
  options.motion = motion;
  const SimulatedTruth truth(options);
  Result result;
  const auto at = [](const JointPositions& joints, std::string_view name) -> Vector3 {
    const auto joint = std::ranges::find(kSimulatedJointNames, name);
    return joints[static_cast<std::size_t>(joint - kSimulatedJointNames.begin())];
  };
  for (int i = 0; i < seconds * fps; ++i) {
    PoseRow& row = result.poses.emplace_back();
    row.frame = i;
    row.timestamp_ns = options.start_ns + std::llround(i * 1e9 / fps);
    row.state = CaptureState::kTracking;
    row.has_pose = true;
    const JointPositions joints = truth.At(row.timestamp_ns);
    for (const Point point : {Point::kHipL, Point::kHipR})
      row.points_W.col(static_cast<int>(point)) = at(joints, kPointNames[static_cast<int>(point)]);
    for (int k = 0; k < kFurtherPointCount; ++k)
      if (!kFurtherPointNames[k].starts_with("clavicle"))
        row.further_W.col(k) = at(joints, kFurtherPointNames[k]);
    std::ranges::copy(truth.ContactsAt(row.timestamp_ns), row.contacts.begin());
  }
  return result;
}

/// A result of before contacts.
Result WithoutContacts(Result result) {
  for (PoseRow& row : result.poses) row.contacts.setConstant(std::nan(""));
  return result;
}

/// A run of a foot, the left, that touches the floor as likely as this; the right one never.
GaitRun RunOf(std::initializer_list<double> contact) {
  GaitRun run;
  for (const double probability : contact) {
    GaitFrame& frame = run.emplace_back();
    frame.time_s = 0.1 * static_cast<double>(run.size() - 1);
    frame.contact = {probability, 0};
  }
  return run;
}

/// The simulated walker takes a step in this time, left foot first (motions/gait.h).
constexpr double kStep_s = 0.53;
/// Share of its cycle that a foot is on the floor.
constexpr double kDuty = 0.62;

TEST(Gait, AContactBeginsAndEndsBetweenFrames) {
  const std::vector<GaitEvent> events = FindContactEvents(RunOf({0, 0, 0.8, 1, 1, 0.9, 0.1, 0}));
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, GaitEventKind::kFootStrike);
  EXPECT_NEAR(events[0].time_s, 0.1 + 0.1 * 0.5 / 0.8, 1e-9);
  EXPECT_EQ(events[1].kind, GaitEventKind::kFootOff);
  EXPECT_NEAR(events[1].time_s, 0.55, 1e-9);
  EXPECT_EQ(events[1].side, Side::kLeft);
}

TEST(Gait, AContactThatFlickersIsOne) {
  GaitRun run = RunOf({0, 1, 1, 1, 0, 1, 1, 1, 0, 0});
  for (GaitFrame& frame : run) frame.time_s *= 0.4;
  EXPECT_EQ(FindContactEvents(run).size(), 2u);
}

TEST(Gait, EventsByContactAreThoseOfTheSimulatedFeet) {
  const Result walk = TrueResult("walk", 10);
  for (const GaitEvent& event : GaitEventsOf(walk)) {
    const double cycles = event.time_s / (2 * kStep_s) - (event.side == Side::kLeft ? 0 : 0.5) -
                          (event.kind == GaitEventKind::kFootOff ? kDuty : 0);
    EXPECT_NEAR(cycles, std::round(cycles), 0.025 / (2 * kStep_s)) << event.time_s;
  }
}

TEST(Gait, FiguresOfAWalkAreTrue) {
  const GaitSummary walk = AnalyseGait(TrueResult("walk", 20)).summary;
  const GaitSummary truth = AnalyseGait(TrueResult("walk", 20, 300)).summary;
  for (const std::size_t side : {0, 1}) {
    EXPECT_NEAR(walk.figures[side][0].mean, truth.figures[side][0].mean, 15) << "step length";
    EXPECT_NEAR(walk.figures[side][5].mean, 60 / kStep_s, 0.02 * 60 / kStep_s) << "cadence";
    EXPECT_NEAR(walk.figures[side][7].mean, 100 * kDuty, 2) << "stance";
    EXPECT_NEAR(walk.figures[side][9].mean, 100 * (2 * kDuty - 1), 3) << "double support";
  }
}

TEST(Gait, PositionsAreACheckOfContacts) {
  const GaitAnalysis gait = AnalyseGait(TrueResult("walk", 10));
  ASSERT_TRUE(gait.check);
  const auto& [strikes, offs] = *gait.check;
  EXPECT_GT(strikes.both, 15);
  EXPECT_GE(strikes.both, strikes.by_contact - 2);
  EXPECT_NEAR(strikes.mean_s, 0, 0.033);
  // A foot that has left the floor lags behind the pelvis for a while.
  EXPECT_GT(offs.mean_s, 0.01);
  EXPECT_LT(offs.mean_s, 0.1);
  EXPECT_EQ(GaitJson(gait)["events_by"], "contact");
  EXPECT_EQ(GaitJson(gait)["event_check"]["Foot Strike"]["both"], strikes.both);
  EXPECT_NE(GaitText(gait).find("events: by contact"), std::string::npos);
}

TEST(Gait, WithoutContactsPositionsTell) {
  const GaitAnalysis gait = AnalyseGait(WithoutContacts(TrueResult("walk", 10)));
  EXPECT_FALSE(gait.check);
  EXPECT_GT(gait.strides.size(), 10u);
  EXPECT_EQ(GaitJson(gait)["events_by"], "position");
  EXPECT_NE(GaitText(gait).find("Zeni"), std::string::npos);
}

TEST(Gait, RunnersAreNeverOnBothFeet) {
  const GaitAnalysis gait = AnalyseGait(TrueResult("run", 10));
  ASSERT_GT(gait.strides.size(), 10u);
  for (const Stride& stride : gait.strides) {
    EXPECT_LT(stride.opposite_off_s, stride.begin_s);
    EXPECT_EQ(stride.both_s(), 0);
  }
}

TEST(Gait, ThePageHasFiguresEventsAndCurves) {
  const std::string html = GaitReportHtml("walk", {{"", AnalyseGait(TrueResult("walk", 10))}});
  for (const char* told : {"step length", "symmetry index", "foot strike", "gait cycle [%]",
                           "knee_angle", "by contact"})
    EXPECT_NE(html.find(told), std::string::npos) << told;
  EXPECT_NE(
      GaitReportHtml("stand", {{"", AnalyseGait(TrueResult("stand", 5))}}).find("No whole stride"),
      std::string::npos);
}

TEST(Gait, FeetStrikeWhenTheSimulatedOnesDo) {
  const Result walk = WithoutContacts(TrueResult("walk", 10));
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
  EXPECT_TRUE(AnalyseGait({}).strides.empty()) << "nobody was tracked";
}

TEST(Gait, ACurveHasTheMeanAndSpreadOfItsStrides) {
  std::vector<BodyAngles> angles(61);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    angles[i].time_ns = static_cast<std::int64_t>(i) * 50'000'000;
    angles[i].leg_l.bend = i < 21 ? 0.1 : 0.3;
    angles[i].pelvis = Vector3(0.5, 0.5, 0.5);
    angles[i].walker_pelvis = Vector3(0.05, 0, 0);
  }
  std::vector<Stride> strides(2);
  strides[0] = {.side = Side::kLeft, .begin_s = 0, .end_s = 1};
  strides[1] = {.side = Side::kLeft, .begin_s = 2, .end_s = 3};
  const std::vector<CycleCurve> curves = CurvesOf(angles, 0, strides);
  const auto knee = std::ranges::find(curves, "knee_angle_l", &CycleCurve::angle);
  ASSERT_NE(knee, curves.end());
  EXPECT_EQ(knee->strides, 2);
  EXPECT_NEAR(knee->mean_deg[50], 0.2 * kDegreesPerRad, 1e-9);
  EXPECT_NEAR(knee->spread_deg[50], std::sqrt(0.02) * kDegreesPerRad, 1e-9);
  EXPECT_NEAR(curves.front().mean_deg[50], 0.05 * kDegreesPerRad, 1e-9) << curves.front().angle;
  for (const CycleCurve& curve : curves) EXPECT_FALSE(curve.angle.ends_with("_r")) << curve.angle;
}

}  // namespace
}  // namespace mocap

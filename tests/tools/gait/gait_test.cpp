#include "tools/gait.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/degrees.h"
#include "drivers/take/text_file.h"
#include "drivers/virtual_studio/truth.h"
#include "tests/support/moving_body.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/gait/gait_analysis.h"
#include "tools/gait/gait_report.h"
#include "tools/gait/gait_text.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using testing::ReadText;
using testing::SetupErrorOf;
using testing::TemporaryFolder;

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

GaitAnalysis Analyse(const Result& result) { return AnalyseGait(result, "walk"); }

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
  const std::vector<GaitEvent> events = GaitEventsOf(TrueResult("walk", 10));
  EXPECT_NEAR(static_cast<double>(events.size()), 2 * 10 / kStep_s, 3);
  for (const GaitEvent& event : events) {
    const double cycles = event.time_s / (2 * kStep_s) - (event.side == Side::kLeft ? 0 : 0.5) -
                          (event.kind == GaitEventKind::kFootOff ? kDuty : 0);
    EXPECT_NEAR(cycles, std::round(cycles), 0.025 / (2 * kStep_s)) << event.time_s;
  }
}

TEST(Gait, FiguresOfAWalkAreTrue) {
  const GaitSummary walk = Analyse(TrueResult("walk", 20)).summary;
  const GaitSummary truth = Analyse(TrueResult("walk", 20, 300)).summary;
  for (const std::size_t side : {0, 1}) {
    EXPECT_NEAR(walk.figures[side][0].mean, truth.figures[side][0].mean, 15) << "step length";
    EXPECT_NEAR(walk.figures[side][5].mean, 60 / kStep_s, 0.02 * 60 / kStep_s) << "cadence";
    EXPECT_NEAR(walk.figures[side][7].mean, 100 * kDuty, 2) << "stance";
    EXPECT_NEAR(walk.figures[side][9].mean, 100 * (2 * kDuty - 1), 3) << "double support";
  }
}

TEST(Gait, PositionsAreACheckOfContacts) {
  const GaitAnalysis gait = Analyse(TrueResult("walk", 10));
  ASSERT_TRUE(gait.check);
  const auto& [strikes, offs] = *gait.check;
  EXPECT_GT(strikes.later_s.count, 15);
  EXPECT_GE(strikes.later_s.count, strikes.by_contact - 2);
  EXPECT_NEAR(strikes.later_s.mean, 0, 0.033);
  // A foot that has left the floor lags behind the pelvis for a while.
  EXPECT_GT(offs.later_s.mean, 0.01);
  EXPECT_LT(offs.later_s.mean, 0.1);
  EXPECT_EQ(GaitJson(gait)["events_by"], "contact");
  EXPECT_EQ(GaitJson(gait)["event_check"]["Foot Strike"]["both"], strikes.later_s.count);
  EXPECT_NE(GaitText(gait).find("events: by contact"), std::string::npos);
}

TEST(Gait, WithoutContactsPositionsTell) {
  const GaitAnalysis gait = Analyse(WithoutContacts(TrueResult("walk", 10)));
  EXPECT_FALSE(gait.check);
  EXPECT_GT(gait.strides.size(), 10u);
  EXPECT_EQ(GaitJson(gait)["events_by"], "position");
  EXPECT_NE(GaitText(gait).find("Zeni"), std::string::npos);
}

TEST(Gait, RunnersAreNeverOnBothFeet) {
  const GaitAnalysis gait = Analyse(TrueResult("run", 10));
  ASSERT_GT(gait.strides.size(), 10u);
  for (const Stride& stride : gait.strides) {
    EXPECT_LT(stride.opposite_off_s, stride.begin_s);
    EXPECT_EQ(stride.both_s(), 0);
  }
}

TEST(Gait, ThePageHasFiguresEventsAndCurves) {
  const std::string html = GaitReportHtml("walk", {{"", Analyse(TrueResult("walk", 10))}});
  for (const char* told : {"step length", "symmetry index", "foot strike", "gait cycle [%]",
                           "knee_angle", "by contact"})
    EXPECT_NE(html.find(told), std::string::npos) << told;
  EXPECT_NE(
      GaitReportHtml("stand", {{"", Analyse(TrueResult("stand", 5))}}).find("No whole stride"),
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
  ASSERT_EQ(runs.size(), 1u);
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
  const GaitAnalysis gait = Analyse(TrueResult("walk", 10));
  ASSERT_GT(gait.strides.size(), 10u);
  for (const auto& side : gait.summary.figures) {
    // 1.08 m/s along the path; the feet take the outer and the inner curve.
    EXPECT_NEAR(side[0].mean, 1080 * kStep_s, 0.15 * 1080 * kStep_s);
    EXPECT_NEAR(side[4].mean, 2 * kStep_s, 0.02 * 2 * kStep_s);
    EXPECT_NEAR(side[5].mean, 60 / kStep_s, 0.02 * 60 / kStep_s);
  }
}

/// One stride of the left foot, from 0 to 1 s, at 1 m/s; the right foot lands 20 cm to the right.
GaitAnalysis OneStride(std::vector<GaitEvent> events) {
  GaitRun run;
  for (const double time_s : {0.0, 0.5, 1.0}) {
    GaitFrame& frame = run.emplace_back();
    frame.time_s = time_s;
    frame.pelvis_W = {1000 * time_s, 0, 900};
    frame.heel_W = {Vector3(1000 * time_s, 100, 0), Vector3(1200 * time_s, -100, 0)};
    frame.toe_W = frame.heel_W;
  }
  GaitAnalysis gait;
  gait.strides = StridesOf(run, events);
  return gait;
}

TEST(Gait, FiguresFollowFromEventsAndHeels) {
  using enum Side;
  using enum GaitEventKind;
  const GaitAnalysis gait = OneStride({{kLeft, kFootStrike, 0},
                                       {kRight, kFootOff, 0.12},
                                       {kRight, kFootStrike, 0.5},
                                       {kLeft, kFootOff, 0.6},
                                       {kLeft, kFootStrike, 1}});
  ASSERT_EQ(gait.strides.size(), 1u);
  const std::array<double, kGaitFigureCount> wanted = {400, 1000, 200, 0.5, 1, 120,
                                                       1,   60,   40,  22,  38};
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_NEAR(kGaitFigures[i].of(gait.strides.front()), wanted[i], 1e-9) << kGaitFigures[i].name;
}

TEST(Gait, AStrideWhoseOtherFootOffWasMissedIsNone) {
  using enum Side;
  using enum GaitEventKind;
  // That at -0.8 s belongs to the other foot's stance before its strike at -0.4 s.
  const GaitAnalysis gait = OneStride({{kRight, kFootOff, -0.8},
                                       {kRight, kFootStrike, -0.4},
                                       {kLeft, kFootStrike, 0},
                                       {kRight, kFootStrike, 0.5},
                                       {kLeft, kFootOff, 0.6},
                                       {kLeft, kFootStrike, 1}});
  EXPECT_TRUE(gait.strides.empty());
}

TEST(Gait, FramesWithoutContactsAreLeftOutWhereOthersHaveThem) {
  const Result walk = TrueResult("walk", 10);
  Result gappy = walk;
  for (const std::size_t frame : {0, 150}) gappy.poses[frame].contacts.setConstant(std::nan(""));
  const GaitAnalysis gait = Analyse(gappy);
  EXPECT_EQ(GaitJson(gait)["events_by"], "contact");
  EXPECT_EQ(GaitRunsOf(gappy).size(), 1u);
  EXPECT_EQ(gait.strides.size(), Analyse(walk).strides.size());
}

TEST(Gait, AStanceEndsWithinItsRun) {
  Result walk = TrueResult("walk", 10);
  walk.poses.erase(walk.poses.begin() + 140, walk.poses.begin() + 172);
  const GaitAnalysis gait = Analyse(walk);
  EXPECT_GT(gait.stances.size(), 10u);
  for (const StancePhase& stance : gait.stances)
    EXPECT_LT(stance.end_s - stance.begin_s, 1) << stance.begin_s;
}

TEST(Gait, TablesAreWrittenAndForeignFilesAreKept) {
  const TemporaryFolder folder;
  const GaitAnalysis gait = Analyse(TrueResult("walk", 10));
  for (const int time : {1, 2}) {
    RequireRoomForGait(folder.path() / "gait");
    WriteGait(folder.path() / "gait", gait);
    const auto lines = [&](const char* name) {
      const std::string text = ReadText(folder.path() / "gait" / name);
      EXPECT_EQ(text.find("nan"), std::string::npos) << name;
      return static_cast<std::size_t>(std::ranges::count(text, '\n'));
    };
    EXPECT_EQ(lines("events.csv"), 1 + gait.events.size()) << "time " << time;
    EXPECT_EQ(lines("strides.csv"), 1 + gait.strides.size());
    EXPECT_EQ(lines("figures.csv"), 1 + kGaitFigureCount);
    EXPECT_EQ(lines("cycle.csv"), 1 + gait.curves.size() * kCycleSamples);
  }
  ReplaceText(folder.path() / "gait/cycle.csv", "mine\n");
  EXPECT_THAT(SetupErrorOf([&] { RequireRoomForGait(folder.path() / "gait"); }),
              HasSubstr("cycle.csv"));
  EXPECT_EQ(ReadText(folder.path() / "gait/cycle.csv"), "mine\n");
}

TEST(Gait, WhoStandsTakesNoStep) {
  const GaitAnalysis gait = Analyse(TrueResult("stand", 10));
  EXPECT_TRUE(gait.strides.empty());
  EXPECT_EQ(GaitJson(gait)["events_by"], "contact") << "they are known, though none begins";
  EXPECT_NE(GaitText(gait).find("no whole stride in 10.0 s"), std::string::npos);
}

TEST(Gait, AGapEndsARun) {
  Result walk = TrueResult("walk", 10);
  walk.poses.erase(walk.poses.begin() + 140, walk.poses.begin() + 160);
  EXPECT_EQ(GaitRunsOf(walk).size(), 2u);
}

TEST(Gait, PosesWithoutFeetAreRefused) {
  Result walk = TrueResult("walk", 1);
  for (PoseRow& row : walk.poses) row.further_W.setConstant(std::nan(""));
  EXPECT_THAT(SetupErrorOf([&] { Analyse(walk); }), HasSubstr("walk: no frame has heels and toes"));
  EXPECT_TRUE(Analyse({}).strides.empty()) << "nobody was tracked";
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

TEST(GaitCommand, WritesTablesAndAPage) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  WriteResult(path("result"), testing::WalkingResult(250));
  CLI::App app;
  AddGaitCommand(app);
  ::testing::internal::CaptureStdout();
  app.parse("gait " + path("result") + " --out " + path("gait") + " --report " + path("gait.html"));
  EXPECT_THAT(::testing::internal::GetCapturedStdout(), HasSubstr("step length"));
  EXPECT_THAT(ReadText(path("gait/figures.csv")), HasSubstr("step length,mm,"));
  EXPECT_THAT(ReadText(path("gait.html")), HasSubstr("gait cycle [%]"));
}

}  // namespace
}  // namespace mocap

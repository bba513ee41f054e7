#include "tools/accuracy/evidence_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/report_data.h"
#include "tools/accuracy/evidence_report.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

EvidenceRow WeakRow(const EvidenceKind& kind, double mpjpe_mm, double hull_share = 0.5) {
  return {.kind = kind,
          .accuracy = {.motion = "walk",
                       .stature_mm = 1750,
                       .seed = 1,
                       .mpjpe_mm = mpjpe_mm,
                       .tracked_share = mpjpe_mm > 0 ? 1.0 : 0.0},
          .hull_share = hull_share};
}

SimulatedStudioOptions FewFrames() {
  SimulatedStudioOptions studio = RecordedSimulation();
  studio.width_px = 320;
  studio.height_px = 240;
  studio.seconds = 0.5;
  return studio;
}

TEST(EvidencePlan, HasEveryContrastWithEveryCrfAndNumberOfCameras) {
  const std::vector<EvidenceKind> kinds = PlannedEvidence();
  EXPECT_EQ(kinds.size(), 36u + 3 + 3);
  for (const double contrast : {40, 20, 15, 10}) {
    for (const std::optional<int> crf : {std::optional<int>(), {18}, {28}}) {
      for (const int cameras : {4, 8, 16})
        EXPECT_EQ(std::ranges::count(kinds, EvidenceKind{contrast, crf, cameras}), 1);
    }
  }
}

TEST(EvidenceTrial, TheHullOfClothesOfFullContrastIsNearlyTheTrueOneAndThatOfWeakOnesSmaller) {
  SimulatedStudioOptions studio = FewFrames();
  studio.width_px = 640;
  studio.height_px = 480;
  const EvidenceRow clear = RunEvidenceTrial(studio);
  EXPECT_EQ(clear.kind, (EvidenceKind{0, std::nullopt, studio.cameras}));
  EXPECT_GT(clear.hull_share, 0.8);
  EXPECT_LT(clear.hull_share, 1.25);
  EXPECT_EQ(clear.accuracy.tracked_share, 1);
  EXPECT_LT(clear.unknown_share, 0.05);
  studio = FewFrames();
  ApplyEvidence({.contrast = 5, .crf = 30, .cameras = 5}, studio);
  const EvidenceRow weak = RunEvidenceTrial(studio);
  EXPECT_EQ(weak.kind, (EvidenceKind{5, 30, 5}));
  EXPECT_LT(weak.hull_share, 0.9 * clear.hull_share);
  EXPECT_GT(weak.hull_share, 0);
  EXPECT_GT(weak.unknown_share, 0.1);
}

TEST(EvidenceTrial, TheSameOptionsGiveTheSameRow) {
  SimulatedStudioOptions studio = FewFrames();
  ApplyEvidence({.contrast = 40, .crf = 28, .cameras = 4}, studio);
  const EvidenceRow first = RunEvidenceTrial(studio), again = RunEvidenceTrial(studio);
  EXPECT_EQ(first.hull_share, again.hull_share);
  EXPECT_EQ(first.unknown_share, again.unknown_share);
  EXPECT_EQ(first.accuracy.mpjpe_mm, again.accuracy.mpjpe_mm);
}

TEST(EvidenceReport, SoftShadowsAndMisledCamerasHaveLinesOfTheirOwn) {
  EvidenceKind shadows{.cameras = 4, .soft_shadows = true};
  EvidenceKind misled{.cameras = 4, .misled_share = 0.1};
  std::vector<EvidenceRow> rows = {WeakRow(shadows, 20), WeakRow(misled, 30)};
  EXPECT_FALSE(LargestRise(SummarizeEvidence(rows)));
  misled.cameras = 8;
  rows.push_back(WeakRow(misled, 40));
  EXPECT_THAT(EvidenceTable(rows), HasSubstr("\n| full, soft shadows | none | 20.0 |"));
  EXPECT_THAT(EvidenceTable(rows), HasSubstr("\n| full, 10 % misled | none | 30.0 |"));
  EXPECT_THAT(EvidenceTable(rows),
              HasSubstr("+10.0 mm, from 4 to 8 cameras at a contrast of full"));
}

TEST(EvidenceReport, FindsTheLargestRiseByMoreCameras) {
  const std::vector<EvidenceRow> rows = {WeakRow({40, std::nullopt, 4}, 30),
                                         WeakRow({40, std::nullopt, 8}, 20),
                                         WeakRow({40, std::nullopt, 16}, 24),
                                         WeakRow({40, 28, 4}, 90),
                                         WeakRow({40, 28, 8}, 80),
                                         WeakRow({10, 28, 16}, 300)};
  const std::vector<EvidenceSummary> kinds = SummarizeEvidence(rows);
  const std::optional<EvidenceRise> rise = LargestRise(kinds);
  ASSERT_TRUE(rise);
  EXPECT_DOUBLE_EQ(rise->mm(), 4);
  EXPECT_EQ(rise->fewer, (EvidenceKind{40, std::nullopt, 8}));
  EXPECT_EQ(rise->more, (EvidenceKind{40, std::nullopt, 16}));
  EXPECT_THAT(EvidenceTable(rows), HasSubstr("+4.0 mm, from 8 to 16 cameras"));
  EXPECT_FALSE(LargestRise(std::vector{kinds.front()}));
}

TEST(EvidenceReport, WhoIsNoLongerTrackedIsTheWorstRise) {
  const std::vector<EvidenceRow> rows = {WeakRow({10, 18, 4}, 30), WeakRow({10, 18, 8}, 50),
                                         WeakRow({10, 18, 16}, 0)};
  const std::optional<EvidenceRise> rise = LargestRise(SummarizeEvidence(rows));
  ASSERT_TRUE(rise);
  EXPECT_EQ(rise->mm(), std::numeric_limits<double>::infinity());
  EXPECT_THAT(EvidenceTable(rows), HasSubstr("nobody is tracked any more, from 4 to 16 cameras"));
  EXPECT_THAT(EvidenceTable(rows), HasSubstr("| – | 0 | 50 | 0 |"));
  EXPECT_THAT(EvidenceLine(rows.back()), HasSubstr("–"));
}

/// Over all plots.
std::size_t CrossesIn(const std::string& html) {
  std::size_t count = 0;
  const auto figures = testing::SectionsOf(testing::ReportData(html), "figure");
  for (const auto& plot : figures[0]["plots"]) count += plot["series"].back()["y"].size();
  return count;
}

TEST(EvidenceReport, MarksTheErrorsThatRise) {
  const std::vector<EvidenceRow> well = {WeakRow({10, 18, 4}, 30), WeakRow({10, 18, 8}, 30.9),
                                         WeakRow({10, 18, 16}, 0)};
  const std::vector<EvidenceRow> ill = {WeakRow({10, 18, 4}, 30), WeakRow({10, 18, 8}, 20),
                                        WeakRow({10, 18, 16}, 21.1)};
  EXPECT_EQ(CrossesIn(EvidenceHtml(well)), 0u);
  EXPECT_EQ(CrossesIn(EvidenceHtml(ill)), 1u);
}

TEST(EvidenceReport, HasALineOfAllCamerasAndMeansOverTakes) {
  std::vector<EvidenceRow> rows = {WeakRow({15, 28, 4}, 30, 0.4), WeakRow({15, 28, 4}, 40, 0.6),
                                   WeakRow({15, 28, 8}, 20, 0.7), WeakRow({15, 28, 16}, 10, 1.2)};
  rows[0].unknown_share = 0.2;
  rows[1].unknown_share = 0.4;
  EXPECT_THAT(
      EvidenceTable(rows),
      HasSubstr("| 15 | 28 | 35.0 | 100 | 50 | 30 | 20.0 | 100 | 70 | 0 | 10.0 | 100 | 120 | 0 |"));
  EXPECT_THAT(EvidenceTable(rows), HasSubstr("-10.0 mm"));
  EXPECT_THAT(EvidenceMarkdown(rows, 2), HasSubstr("evidence.html"));
  EXPECT_THAT(EvidenceHtml(rows), HasSubstr("cameras, crf 28"));
  EXPECT_THAT(EvidenceHtml(rows), HasSubstr("contrast 40"));
  EXPECT_EQ(EvidenceMarkdown({}, 2), "");
  EXPECT_EQ(EvidenceTable({}), "");
}

}  // namespace
}  // namespace mocap

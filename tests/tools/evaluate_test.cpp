#include "tools/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"
#include "tests/support/box_take.h"
#include "tests/support/report_data.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/report/evaluation.h"
#include "tools/report/evaluation_text.h"
#include "tools/report/report.h"
#include "tools/take_samples.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

using namespace ::mocap::testing;  // NOLINT: the box and its take.

class EvaluateTest : public ::testing::Test {
 protected:
  EvaluateTest() {
    WriteBoxTake(take_);
    WriteBoxResult(result_);
  }

  std::string Run(const std::vector<std::string>& arguments) const {
    CLI::App app;
    AddEvaluateCommand(app);
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    ::testing::internal::CaptureStdout();
    try {
      app.parse(reversed);
    } catch (...) {
      ::testing::internal::GetCapturedStdout();
      throw;
    }
    return ::testing::internal::GetCapturedStdout();
  }

  /// The data of the report of this take and result.
  nlohmann::ordered_json Report() const {
    const std::filesystem::path report = folder_.path() / "report.html";
    Run({"evaluate", take_.string(), result_.string(), "--report", report.string()});
    return ReportData(testing::ReadText(report));
  }

  const testing::TemporaryFolder folder_;
  const std::filesystem::path take_ = folder_.path() / "take", result_ = folder_.path() / "result";
};

TEST_F(EvaluateTest, PrintsOneJsonObjectWithTheFigures) {
  const std::string json = Run({"evaluate", take_.string(), result_.string(), "--json"});
  EXPECT_THAT(json, ::testing::MatchesRegex("\\{[^\n]*\\}\n"));
  EXPECT_THAT(json, HasSubstr("\"frames\":20,"));
  EXPECT_THAT(json, HasSubstr("\"acquiring\":2,\"tracking\":18,"));
  EXPECT_THAT(json, HasSubstr("\"tracked_share\":1,"));
  EXPECT_THAT(json, HasSubstr("\"first_tracked_frame\":2,"));
  EXPECT_THAT(json, HasSubstr("\"mpjpe_mm\":12,\"median_mm\":12,\"p95_mm\":12"));
  EXPECT_THAT(json, HasSubstr("\"head_found_share\":1,"));
  EXPECT_THAT(json, HasSubstr("\"angle_mae_deg\":0,"));
  EXPECT_THAT(json, HasSubstr("\"length_error_mm\":{\"torso_mm\":10}"));
  EXPECT_THAT(json, HasSubstr("\"precision\":{\"frames\":18,"));
  EXPECT_THAT(json, HasSubstr("\"point_mean_mm\":0,"));
}

TEST_F(EvaluateTest, PrintsATableForPeople) {
  const std::string text = Run({"evaluate", take_.string(), result_.string()});
  EXPECT_THAT(text, HasSubstr("12.0 mm mean over 14 points"));
  EXPECT_THAT(text, HasSubstr("tracked     100.0 % from frame 2 on"));
  EXPECT_THAT(text, HasSubstr("tracked 100.0 % of 18 frames with truth (after 2 more in which"));
  EXPECT_THAT(text, HasSubstr("fingertips_r       12.0"));
}

TEST_F(EvaluateTest, AReportIsAPageByItsName) {
  const std::string pdf = (folder_.path() / "report.pdf").string();
  EXPECT_THAT(SetupErrorOf([&] {
                Run({"evaluate", take_.string(), result_.string(), "--report", pdf});
              }),
              HasSubstr("report.pdf: does not end in .html"));
}

TEST_F(EvaluateTest, OfNobodyThereIsNoBody) {
  Result result = ReadResult(result_);
  for (PoseRow& row : result.poses) row.has_pose = false, row.state = CaptureState::kSearching;
  WriteResult(result_, result);
  const std::string text = Run({"evaluate", take_.string(), result_.string()});
  EXPECT_THAT(text, AllOf(HasSubstr("20 frames, nobody was tracked\n"), Not(HasSubstr("stature")),
                          Not(HasSubstr("length"))));
  EXPECT_THAT(Run({"evaluate", take_.string(), result_.string(), "--json"}),
              AllOf(Not(HasSubstr("stature")), Not(HasSubstr("first_tracked_frame"))));
}

TEST_F(EvaluateTest, FramesAreThoseOfTheResultWhateverTruthThereIs) {
  // The person came in later than the take begins.
  const std::filesystem::path file = take_ / "truth.csv";
  std::string truth = testing::ReadText(file);
  const std::size_t first_row = truth.find('\n') + 1;
  std::size_t row = first_row;
  for (int i = 0; i < 5; ++i) row = truth.find('\n', row) + 1;
  testing::WriteText(file, truth.erase(first_row, row - first_row));
  EXPECT_THAT(Run({"evaluate", take_.string(), result_.string(), "--json"}),
              AllOf(HasSubstr("\"frames\":20,\"truth_frames\":15"),
                    HasSubstr("\"first_tracked_frame\":2,")));
}

TEST_F(EvaluateTest, TellsWhatFitAndDeviationsAreWorth) {
  Result result = ReadResult(result_);
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    PoseRow& row = result.poses[i];
    // Where the body fits badly, it is farther off: 12 and 24 mm.
    if (i % 2 == 0) {
      row.residual_mm = 16;
      row.points_W.row(2).array() += 12;
    }
    row.point_std_mm.setConstant(7);
  }
  WriteResult(result_, result);
  const std::string json = Run({"evaluate", take_.string(), result_.string(), "--json"});
  EXPECT_THAT(json, HasSubstr("\"residual_p95_mm\":16,\"deviation_median_mm\":7,"
                              "\"error_of_better_half_mm\":12,\"error_of_worse_half_mm\":24,"
                              "\"errors_within_two_deviations\":0.5}"));
  EXPECT_THAT(
      Run({"evaluate", take_.string(), result_.string()}),
      HasSubstr("95 % below 16.0 mm; mean error 12.0 mm in the half that fits better, 24.0 "
                "mm in the other\ndeviation   7.0 mm (median); errors within twice the deviation: "
                "50 %\n"));
  std::filesystem::remove(take_ / "truth.csv");
  EXPECT_THAT(Run({"evaluate", take_.string(), result_.string()}),
              HasSubstr("95 % below 16.0 mm\ndeviation   7.0 mm (median)\n"));
}

TEST_F(EvaluateTest, TellsHowTrueProbabilitiesAre) {
  Result result = ReadResult(result_);
  // All are 12 mm off, but for two of the eight with 0.6: these are 112 mm off.
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    PoseRow& row = result.poses[i];
    row.probability = i < 10 ? 0.6 : i == 10 ? 0.9 : 1;
    if (i % 5 < 2 && i < 10) row.points_W.row(2).array() += 100;
    if (i == 19) row.probability = std::nan("");
  }
  WriteResult(result_, result);
  // Nobody is tracked in the first two of 20.
  const std::string json = Run({"evaluate", take_.string(), result_.string(), "--json"});
  EXPECT_THAT(json, HasSubstr("\"probabilities\":[{\"from\":0,\"to\":0.5,\"frames\":0},"
                              "{\"from\":0.5,\"to\":0.9,\"frames\":8,"
                              "\"mean_probability\":0.6,\"right_share\":0.75},"
                              "{\"from\":0.9,\"to\":1,\"frames\":9,"
                              "\"mean_probability\":0.9889,\"right_share\":1}]"));
  EXPECT_THAT(Run({"evaluate", take_.string(), result_.string()}),
              HasSubstr("\n  probability      frames     mean    right    right: mean error below "
                        "100 mm\n"
                        "  0 to 0.5              0        -        -\n"
                        "  0.5 to 0.9            8    0.600   75.0 %\n"
                        "  0.9 to 1              9    0.989  100.0 %\n"));
}

TEST_F(EvaluateTest, WithoutProbabilitiesThereIsNoTableOfThem) {
  EXPECT_THAT(Run({"evaluate", take_.string(), result_.string()}), Not(HasSubstr("probability")));
  EXPECT_THAT(Run({"evaluate", take_.string(), result_.string(), "--json"}),
              Not(HasSubstr("probabilities")));
}

TEST_F(EvaluateTest, SaysWhatItCanWithoutTruth) {
  std::filesystem::remove(take_ / "truth.csv");
  const std::string json = Run({"evaluate", take_.string(), result_.string(), "--json"});
  EXPECT_THAT(json, Not(HasSubstr("mpjpe")));
  EXPECT_THAT(json, HasSubstr("\"precision\""));
  EXPECT_THAT(Run({"evaluate", take_.string(), result_.string()}), HasSubstr("no truth"));
}

TEST_F(EvaluateTest, ReportStandsAlone) {
  const std::filesystem::path report = folder_.path() / "report.html";
  const std::string json =
      Run({"evaluate", take_.string(), result_.string(), "--json", "--report", report.string()});
  EXPECT_THAT(json, HasSubstr("\"hull_iou\":{\"east\":"));
  EXPECT_THAT(json, HasSubstr("\"unknown_share\":{\"east\":0"));
  const std::string html = testing::ReadText(report);
  // Nothing is loaded: no address, and scripts, styles and pictures only from within.
  EXPECT_THAT(html, HasSubstr("default-src 'none'; script-src 'sha256-"));
  EXPECT_THAT(html, Not(HasSubstr("src=\"")));
  EXPECT_THAT(html, Not(HasSubstr("<link rel=\"stylesheet")));
  EXPECT_THAT(html, Not(ContainsRegex("(^|\n)import ")));
  EXPECT_THAT(html, Not(ContainsRegex("https?://[^w]")));
  EXPECT_THAT(html, Not(HasSubstr(folder_.path().string())));
  Run({"evaluate", take_.string(), result_.string(), "--report", report.string()});
  EXPECT_EQ(testing::ReadText(report), html) << "the same again";
}

TEST_F(EvaluateTest, ReportHasAllFigures) {
  const auto data = Report();
  EXPECT_EQ(data["title"], "take");
  EXPECT_THAT(data["under"], HasSubstr("20 frames in"));
  for (const char* title : {"Part sizes", "Path of the torso’s centroid", "Hip and knee angles",
                            "Distance from the truth", "Angles from points alone", "Fit",
                            "Overlap of the voxels, projected back, and the silhouettes"}) {
    EXPECT_FALSE(FigureOf(data, title).is_null()) << title;
  }
  const auto tile = SectionsOf(data, "tiles")[0]["tiles"][0];
  EXPECT_EQ(tile["name"], "Error of 14 points");
  EXPECT_EQ(tile["value"], 12);
  const auto points = TableOf(data, "mean error of point");
  EXPECT_EQ(points["rows"].size(), 14u);
  EXPECT_EQ(points["rows"][0], (nlohmann::ordered_json{"head", 12}));
  EXPECT_EQ(TableOf(data, "mean error of angle")["rows"].size(), 8u);
  EXPECT_EQ(TableOf(data, "length")["rows"][0][3], 10) << "the error of the torso";
  EXPECT_EQ(TableOf(data, "angle")["rows"].size(), 16u);
  EXPECT_EQ(TableOf(data, "point")["rows"].size(), 23u);
  EXPECT_EQ(TableOf(data, "camera")["rows"].size(), 3u);
}

TEST_F(EvaluateTest, ReportHasAValueForEachFrameAndNoneWhereNobodyIsTracked) {
  const auto data = Report();
  const auto states = SectionsOf(data, "states")[0]["people"][0];
  EXPECT_EQ(states["states"].size(), 20u);
  EXPECT_EQ(states["x"]["first"], 0);
  const auto plot = FigureOf(data, "Distance from the truth")["plots"][0];
  EXPECT_EQ(plot["x"]["first"], 0);
  const auto& errors = plot["series"][0]["y"];
  ASSERT_EQ(errors.size(), 20u);
  EXPECT_TRUE(errors[1].is_null());
  EXPECT_EQ(errors[2], 12);
  const auto angles = FigureOf(data, "Angles from points alone")["plots"];
  ASSERT_EQ(angles.size(), 8u);
  EXPECT_EQ(angles[0]["series"][0]["y"], angles[0]["series"][1]["y"]) << "moved, but not bent";
}

TEST_F(EvaluateTest, ReportHasPicturesWithTheirLines) {
  const auto pictures = SectionsOf(Report(), "pictures");
  ASSERT_EQ(pictures.size(), 1u);
  ASSERT_EQ(pictures[0]["moments"].size(), 4u);
  const auto picture = pictures[0]["moments"][0]["pictures"][0];
  EXPECT_THAT(picture["name"], HasSubstr("east · IoU "));
  EXPECT_THAT(picture["jpeg"], HasSubstr("data:image/jpeg;base64,"));
  EXPECT_FALSE(picture["silhouette"].empty());
  EXPECT_EQ(picture["body"][0]["person"], nullptr) << "of one person, the sides have colours";
  for (const auto& line : picture["silhouette"]) {
    for (std::size_t i = 0; i < line["points"].size(); ++i) {
      EXPECT_GE(line["points"][i], 0);
      EXPECT_LT(line["points"][i], picture[i % 2 == 0 ? "width_px" : "height_px"]);
    }
  }
}

TEST_F(EvaluateTest, ATakeCalledAsMarkupIsOnlyText) {
  const std::filesystem::path evil = folder_.path() / "<script>alert(1)<" / "script><!--";
  std::filesystem::create_directories(evil.parent_path());
  std::filesystem::rename(take_, evil);
  const std::filesystem::path report = folder_.path() / "report.html";
  Run({"evaluate", evil.string(), result_.string(), "--report", report.string()});
  const std::string html = testing::ReadText(report);
  EXPECT_EQ(ReportData(html)["title"], "script><!--");
  EXPECT_THAT(html, Not(HasSubstr("<!--\"")));
  EXPECT_THAT(html, HasSubstr("\\u003c!--"));
}

TEST_F(EvaluateTest, ReportOfAPersonNeverTrackedStillShowsTheCameras) {
  Result result = ReadResult(result_);
  for (PoseRow& row : result.poses) {
    row.state = CaptureState::kSearching;
    row.has_pose = false;
  }
  WriteResult(result_, result);
  const std::filesystem::path report = folder_.path() / "report.html";
  Run({"evaluate", take_.string(), result_.string(), "--report", report.string()});
  const std::string html = testing::ReadText(report);
  EXPECT_THAT(html, HasSubstr("never tracked"));
  EXPECT_EQ(SectionsOf(ReportData(html), "pictures")[0]["moments"].size(), 4u);
}

TEST_F(EvaluateTest, OfSeveralPeopleEachHasARowAndAColour) {
  std::filesystem::rename(result_, folder_.path() / "one");
  const Result one = ReadResult(folder_.path() / "one");
  Result other = one;
  for (PoseRow& row : other.poses) row.points_W.row(0).array() += 4000;
  WritePeople(result_, {{1, one}, {2, other}});
  const std::filesystem::path report = folder_.path() / "report.html";
  const std::string text =
      Run({"evaluate", take_.string(), result_.string(), "--report", report.string()});
  EXPECT_THAT(text, HasSubstr("2 people tracked, 1 person there"));
  EXPECT_THAT(text, HasSubstr("frames of tracks without a person (phantom): 18"));
  EXPECT_THAT(Run({"evaluate", take_.string(), result_.string(), "--json"}),
              ::testing::MatchesRegex("\\{[^\n]*\\}\n"));
  const auto data = ReportData(testing::ReadText(report));
  const auto rows = TableOf(data, "tracked")["rows"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1][0], (nlohmann::ordered_json{{"text", "person-2"}, {"figure", 1}}));
  EXPECT_EQ(rows[0][5], 12) << "the error";
  EXPECT_EQ(rows[1][6], 18) << "phantom frames";
  EXPECT_EQ(SectionsOf(data, "states")[0]["people"].size(), 2u);
  EXPECT_EQ(SectionsOf(data, "details").size(), 2u);
  const auto body = SectionsOf(data, "pictures")[0]["moments"][0]["pictures"][0]["body"];
  EXPECT_EQ(body.front()["person"], 0);
  EXPECT_EQ(body.back()["person"], 0) << "the other is outside the picture";
  EXPECT_EQ(FigureOf(data, "Distance from the truth")["plots"][0]["series"].size(), 2u);
}

TEST_F(EvaluateTest, RefusesAReportThatCannotBeWritten) {
  EXPECT_THROW(Run({"evaluate", take_.string(), result_.string(), "--report",
                    (folder_.path() / "absent" / "report.html").string()}),
               SetupError);
}

TEST_F(EvaluateTest, RefusesATakeThatIsNotThere) {
  EXPECT_THROW(Run({"evaluate", (folder_.path() / "absent").string(), result_.string()}),
               SetupError);
}

TEST_F(EvaluateTest, SamplesTheFrameNearestToEachMomentAndCarvesIt) {
  const TakeSamples samples = SampleTake(
      take_, {{kFirstNs + 3 * kPeriodNs + 40'000'000, true}, {kFirstNs + 15 * kPeriodNs, false}},
      50);
  ASSERT_EQ(samples.moments.size(), 2u);
  ASSERT_EQ(samples.cameras.size(), 3u);
  ASSERT_TRUE(samples.moments[0].views[2]);
  EXPECT_EQ(samples.moments[0].views[0]->image.pixels(), Picture(true, 1009).pixels());
  EXPECT_EQ(samples.moments[0].views[2]->image.pixels(), Picture(true, 1011).pixels());
  // Missed by the third camera, and no picture was asked for.
  EXPECT_FALSE(samples.moments[1].views[2]);
  ASSERT_TRUE(samples.moments[1].views[0]);
  EXPECT_TRUE(samples.moments[1].views[0]->image.empty());
  EXPECT_TRUE(samples.moments[1].views[0]->trimap.person.Test(kWidth / 2, kHeight / 2));
  EXPECT_FALSE(samples.moments[1].views[0]->trimap.person.Test(20, 20));
  for (const CameraOverlap& overlap : MeasureOverlaps(samples)) EXPECT_GT(overlap.mean(), 0.6);
}

TEST(ReportMoments, AreSpreadOverTrackedFrames) {
  Evaluation evaluation;
  for (int i = 0; i < 100; ++i) {
    PoseRow& row = evaluation.result.poses.emplace_back();
    row.timestamp_ns = i;
    row.has_pose = true;
    row.state = i < 20 ? CaptureState::kAcquiring : CaptureState::kTracking;
  }
  evaluation.first_tracked_pose = 20;
  const std::vector<SampleRequest> moments = ChooseReportMoments(evaluation);
  ASSERT_EQ(moments.size(), 20u);
  EXPECT_EQ(moments.front().timestamp_ns, 22);
  EXPECT_EQ(moments.back().timestamp_ns, 98);
  EXPECT_EQ(std::ranges::count(moments, true, &SampleRequest::keep_images), 4);
}

TEST(ReportMoments, OfAShortResultAreAllItsFrames) {
  Evaluation evaluation;
  evaluation.result.poses.resize(3);
  EXPECT_EQ(ChooseReportMoments(evaluation).size(), 3u);
  evaluation.result.poses.clear();
  EXPECT_TRUE(ChooseReportMoments(evaluation).empty());
}

}  // namespace
}  // namespace mocap

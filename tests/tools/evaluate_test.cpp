#include "tools/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "core/errors.h"
#include "drivers/take/take_writer.h"
#include "tests/support/temporary_folder.h"
#include "tools/report/evaluation.h"
#include "tools/report/evaluation_text.h"
#include "tools/report/report.h"
#include "tools/take_samples.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kWidth = 320, kHeight = 240, kFrames = 20;
constexpr std::int64_t kFirstNs = 1'000'000'000'000, kPeriodNs = 100'000'000;

/// A camera 3 m from (0, 0, 1 m) in a direction of the floor, looking at it.
CameraCalibration CameraAt(const std::string& name, const Vector3& direction_W) {
  CameraCalibration camera;
  camera.name = name;
  camera.width_px = kWidth;
  camera.height_px = kHeight;
  OpenCvLens lens;
  lens.K << 400, 0, kWidth / 2.0, 0, 400, kHeight / 2.0, 0, 0, 1;
  camera.lens = lens;
  Matrix3 R_CW;
  R_CW.row(2) = -direction_W.transpose();
  R_CW.row(1) = -Vector3::UnitZ().transpose();
  R_CW.row(0) = Vector3(R_CW.row(1)).cross(Vector3(R_CW.row(2))).transpose();
  camera.X_CW = {R_CW, -(R_CW * (3000 * direction_W + Vector3(0, 0, 1000)))};
  return camera;
}

/// A grey room with a little noise, and a dark box of 450 mm in its middle.
Image<Bgr> Picture(bool with_box, std::uint32_t seed) {
  std::mt19937 random(seed);
  Image<Bgr> image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool in_box =
          with_box && std::abs(x - kWidth / 2) < 30 && std::abs(y - kHeight / 2) < 30;
      const auto value = static_cast<std::uint8_t>((in_box ? 20 : 140) + random() % 7);
      image(x, y) = {value, value, static_cast<std::uint8_t>(value + (in_box ? 60 : 0))};
    }
  }
  return image;
}

BodyPoints TruePoints(int frame) {
  BodyPoints points = BodyPoints::Zero();
  for (int i = 0; i < kPointCount; ++i) {
    points.col(i) = Vector3(10 * i, (i % 3) * 50 - 50, 400 + 40 * i) + Vector3(3 * frame, 0, 0);
  }
  return points;
}

/// A take of three cameras with truth and a result that is 12 mm off in z.
class EvaluateTest : public ::testing::Test {
 protected:
  EvaluateTest() {
    WriteTake();
    WriteTracking();
  }

  void WriteTake() const {
    TakeDescription description{"<box>", 10, {}, {}};
    description.cameras = {CameraAt("east", {1, 0, 0}), CameraAt("north", {0, 1, 0}),
                           CameraAt("west", {-1, 0, 0})};
    TakeWriter writer(take_, description);
    std::vector<std::string> joints;
    for (const Point point : kScoredPoints) {
      const std::string name(kPointNames[static_cast<int>(point)]);
      joints.push_back(name.starts_with("foot") ? "ankle" + name.substr(4) : name);
    }
    writer.SetTruthPoints(joints);
    for (int camera = 0; camera < 3; ++camera) {
      for (int i = 0; i < 12; ++i) {
        writer.WriteBackground(camera, Picture(false, 50 * camera + i).view(), i * kPeriodNs);
      }
    }
    for (int frame = 0; frame < kFrames; ++frame) {
      const std::int64_t time_ns = kFirstNs + frame * kPeriodNs;
      for (int camera = 0; camera < 3; ++camera) {
        // The camera in the west misses the second half.
        if (camera == 2 && frame >= kFrames / 2) continue;
        writer.WriteFrame(camera, Picture(true, 1000 + 3 * frame + camera).view(),
                          time_ns + 1'000'000 * camera);
      }
      const ScoredPoints points = ScoredPointsOf(TruePoints(frame));
      writer.WriteTruth(time_ns,
                        std::vector<Vector3>(points.colwise().begin(), points.colwise().end()));
    }
    writer.WriteTruthSizes({1700, 0, {{"torso_mm", 550}}});
    writer.Finish();
  }

  void WriteTracking() const {
    Result result;
    result.body.model = "full";
    result.body.stature_mm = 1712;
    result.body.sizes.torso = 560;
    for (int frame = 0; frame < kFrames; ++frame) {
      PoseRow& row = result.poses.emplace_back();
      row.frame = frame;
      row.timestamp_ns = kFirstNs + frame * kPeriodNs;
      row.state = frame < 2 ? CaptureState::kAcquiring : CaptureState::kTracking;
      row.has_pose = true;
      row.points_W = TruePoints(frame).colwise() + Vector3(0, 0, 12);
      row.residual_mm = 8;
      row.voxels = 5000;
    }
    WriteResult(result_, result);
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

  const testing::TemporaryFolder folder_;
  const std::filesystem::path take_ = folder_.path() / "take", result_ = folder_.path() / "result";
};

TEST_F(EvaluateTest, PrintsOneJsonObjectWithTheFigures) {
  const std::string json = Run({"evaluate", take_.string(), result_.string(), "--json"});
  EXPECT_THAT(json, ::testing::MatchesRegex("\\{[^\n]*\\}\n"));
  EXPECT_THAT(json, HasSubstr("\"frames\": 20,"));
  EXPECT_THAT(json, HasSubstr("\"acquiring\": 2, \"tracking\": 18,"));
  EXPECT_THAT(json, HasSubstr("\"tracked_share\": 1,"));
  EXPECT_THAT(json, HasSubstr("\"first_tracked_frame\": 2,"));
  EXPECT_THAT(json, HasSubstr("\"mpjpe_mm\": 12, \"median_mm\": 12, \"p95_mm\": 12"));
  EXPECT_THAT(json, HasSubstr("\"head_found_share\": 1,"));
  EXPECT_THAT(json, HasSubstr("\"angle_mae_deg\": 0,"));
  EXPECT_THAT(json, HasSubstr("\"length_error_mm\": {\"torso_mm\": 10}"));
  EXPECT_THAT(json, HasSubstr("\"precision\": {\"frames\": 18,"));
  EXPECT_THAT(json, HasSubstr("\"point_mean_mm\": 0,"));
}

TEST_F(EvaluateTest, PrintsATableForPeople) {
  const std::string text = Run({"evaluate", take_.string(), result_.string()});
  EXPECT_THAT(text, HasSubstr("12.0 mm mean over 14 points"));
  EXPECT_THAT(text, HasSubstr("tracked 100.0 % from frame 2 of 20"));
  EXPECT_THAT(text, HasSubstr("fingertips_r       12.0"));
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
  EXPECT_THAT(json, HasSubstr("\"hull_iou\": {\"east\": "));
  const std::string html = testing::ReadText(report);
  // Nothing is loaded: no script, no address, and pictures only from within.
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("src=")));
  EXPECT_THAT(html, HasSubstr("href=\"data:image/jpeg;base64,"));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
  for (const char* part : {"Fig. 17", "Fig. 21", "Fig. 22", "Accuracy", "Precision", "IoU"}) {
    EXPECT_THAT(html, HasSubstr(part));
  }
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
  EXPECT_THAT(html, HasSubstr("data:image/jpeg"));
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
  EXPECT_TRUE(samples.moments[1].views[0]->silhouette.Test(kWidth / 2, kHeight / 2));
  EXPECT_FALSE(samples.moments[1].views[0]->silhouette.Test(20, 20));
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

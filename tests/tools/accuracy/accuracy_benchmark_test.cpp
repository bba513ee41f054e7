#include "tools/accuracy/accuracy_benchmark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "drivers/virtual_studio/room/camera_rig.h"
#include "tools/accuracy/accuracy_report.h"
#include "tools/accuracy/sweep_plan.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

AccuracyRow Row(double mpjpe_mm, double tracked_share, int acquisition_frames, int wrong) {
  return {.motion = "walk",
          .stature_mm = 1750,
          .seed = 1,
          .mpjpe_mm = mpjpe_mm,
          .tracked_share = tracked_share,
          .acquisition_frames = acquisition_frames,
          .longest_wrong_stretch = wrong};
}

TEST(AccuracySummary, CountsWhatTheMeanHides) {
  const AccuracySummary summary = Summarize(
      {Row(10, 1, 2, 0), Row(20, 0.9, 3, kLongestGlitch), Row(60, 1, 9, kLongestGlitch + 1)});
  EXPECT_DOUBLE_EQ(summary.mpjpe_mm, 30);
  EXPECT_DOUBLE_EQ(summary.worst_mpjpe_mm, 60);
  EXPECT_EQ(summary.takes_with_loss, 1);
  EXPECT_EQ(summary.takes_with_wrong_stretch, 1);
  EXPECT_EQ(summary.median_acquisition_frames, 3);
  EXPECT_EQ(summary.most_acquisition_frames, 9);
}

TEST(AccuracyReport, ShowsAPlotOnlyOfSweepsThatWereMade) {
  AccuracyBenchmark benchmark{.seconds = 10, .grid = {Row(10, 1, 2, 0)}, .sweeps = {}};
  EXPECT_THAT(AccuracyMarkdown(benchmark), Not(HasSubstr("accuracy.html")));
  benchmark.sweeps = {{"cameras", {{"4", Summarize(benchmark.grid)}}}};
  EXPECT_THAT(AccuracyMarkdown(benchmark), HasSubstr("accuracy.html"));
  EXPECT_THAT(AccuracySweepsHtml(benchmark.sweeps), HasSubstr("\"label\":\"cameras\""));
}

TEST(AccuracyReport, StudiosHaveATableOfTheirOwn) {
  AccuracyBenchmark benchmark{.seconds = 2, .grid = {}, .sweeps = {}};
  EXPECT_THAT(AccuracyMarkdown(benchmark), Not(HasSubstr("Studios")));
  benchmark.studios = {"studio", {{"2 cameras", Summarize({Row(40, 1, 2, 0), Row(80, 1, 2, 0)})}}};
  EXPECT_THAT(AccuracyMarkdown(benchmark), HasSubstr("| 2 cameras | 60.0 | 80.0 |"));
}

/// What a step of a plan makes of the usual trial.
AccuracyTrial Changed(const SweepStep& step) {
  AccuracyTrial trial;
  step.change(trial);
  return trial;
}

TEST(StudioPlan, NoTwoStudiosAreAlikeAndTheFirstIsTheUsual) {
  const auto things = [](const AccuracyTrial& trial) {
    const SimulatedStudioOptions& studio = trial.studio;
    return std::vector<double>{static_cast<double>(studio.cameras), studio.camera_height_mm,
                               studio.camera_arc_rad, static_cast<double>(studio.width_px),
                               studio.fps};
  };
  const std::vector<SweepStep> steps = PlannedStudios().steps;
  EXPECT_EQ(things(Changed(steps[0])), things(AccuracyTrial()));
  std::set<std::vector<double>> studios;
  for (const SweepStep& step : steps) {
    EXPECT_TRUE(studios.insert(things(Changed(step))).second) << step.label;
  }
}

TEST(StudioPlan, CamerasHangAsHighAndAsFarApartAsAsked) {
  simulation::RigOptions options{.cameras = 6};
  const std::vector<CameraCalibration> usual = simulation::HangCameras(options);
  options.height_mm -= 1000;
  const std::vector<CameraCalibration> low = simulation::HangCameras(options);
  options.arc_rad /= 4;
  for (std::size_t i = 0; i < usual.size(); ++i) {
    EXPECT_NEAR(usual[i].X_CW.Inverse().p.z() - low[i].X_CW.Inverse().p.z(), 1000, 1e-6);
  }
  double least_cosine = 1;
  const std::vector<CameraCalibration> near = simulation::HangCameras(options);
  for (const CameraCalibration& a : near) {
    for (const CameraCalibration& b : near) {
      const Vector2 p_a = a.X_CW.Inverse().p.head<2>(), p_b = b.X_CW.Inverse().p.head<2>();
      least_cosine = std::min(least_cosine, p_a.normalized().dot(p_b.normalized()));
    }
  }
  EXPECT_GT(least_cosine, 0) << "within a quarter of the circle";
}

TEST(AccuracyTrial, CamerasThatFailAndWrongCalibrationCostALittle) {
  AccuracyTrial trial;
  trial.studio.width_px = 320;
  trial.studio.height_px = 240;
  trial.studio.seconds = 0.8;
  const AccuracyRow well = Measure(trial);
  EXPECT_EQ(well.tracked_share, 1);
  EXPECT_EQ(well.longest_wrong_stretch, 0);
  EXPECT_EQ(Measure(trial).mpjpe_mm, well.mpjpe_mm);
  trial.calibration_error_px = 1;
  trial.mishap = Mishap::kLost;
  const AccuracyRow worse = Measure(trial);
  EXPECT_GT(worse.mpjpe_mm, well.mpjpe_mm);
  EXPECT_LT(worse.mpjpe_mm, 4 * well.mpjpe_mm);
  trial.calibration_error_px = 0;
  for (const Mishap mishap : {Mishap::kBlinded, Mishap::kTurned}) {
    trial.mishap = mishap;
    const AccuracyRow without = Measure(trial);
    EXPECT_EQ(without.tracked_share, 1);
    EXPECT_LT(without.mpjpe_mm, 1.5 * well.mpjpe_mm);
  }
}

}  // namespace
}  // namespace mocap

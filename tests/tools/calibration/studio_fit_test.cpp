#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "drivers/virtual_studio/room/printed_board.h"
#include "tests/support/setup_error.h"
#include "tests/tools/calibration/simulated_board.h"
#include "tools/calibration/extrinsics.h"
#include "tools/calibration/floor.h"
#include "tools/calibration/lens_fit.h"
#include "tools/calibration/placement.h"
#include "tools/calibration/studio_check.h"

namespace mocap {
namespace {

using simulation::BoardOnFloor;
using testing::BoardWalk;
using ::testing::HasSubstr;
using testing::SeeStillBoard;
using testing::WalkBoard;

std::vector<CameraCalibration> FitAllLenses(const BoardDetections& detections, LensModel model) {
  LensFitOptions options;
  options.model = model;
  options.most_views = 30;
  std::vector<CameraCalibration> cameras;
  for (std::size_t c = 0; c < detections.cameras.size(); ++c) {
    const DetectionCamera& camera = detections.cameras[c];
    cameras.push_back({camera.name,
                       camera.width_px,
                       camera.height_px,
                       FitLens(detections, static_cast<int>(c), options).lens,
                       {},
                       {}});
  }
  return cameras;
}

StudioFit Calibrate(const std::vector<CameraCalibration>& truth, const BoardWalk& walk,
                    LensModel model) {
  const BoardDetections detections = WalkBoard(truth, walk);
  StudioFit fit = FitExtrinsics(detections, FitAllLenses(detections, model), {});
  // Pictures of a board that lies still are averaged.
  const BoardDetections floor = SeeStillBoard(truth, walk.board, BoardOnFloor(), walk.noise_px / 2);
  const RigidTransform X_WB = FindStillBoard(floor, fit.bundle.cameras);
  MoveWorld(WorldOnBoard(X_WB, fit.bundle.cameras, 0), fit.bundle);
  fit.has_floor = true;
  MeasureFit(fit);
  return fit;
}

class StudioFitTest : public ::testing::TestWithParam<unsigned> {};

TEST_P(StudioFitTest, PlacesPointsInTheRoomWithinTwoMillimetres) {
  const std::vector<CameraCalibration> truth = testing::SeededRig(GetParam());
  BoardWalk walk;
  walk.seed = GetParam();
  const StudioFit fit = Calibrate(truth, walk, LensModel::kTsai);
  const PlacementDifference errors = ComparePlacement(fit.bundle.cameras, truth);
  EXPECT_LE(errors.mean_mm, 2);
  EXPECT_LE(errors.worst_mm, 5);
  RecordProperty("mean_mm", std::to_string(errors.mean_mm));
  RecordProperty("worst_mm", std::to_string(errors.worst_mm));
  EXPECT_NEAR(fit.rms_px, walk.noise_px * std::sqrt(2.0), 0.05);
  for (const Finding& finding : CheckFit(fit)) EXPECT_NE(finding.severity, Severity::kWrong);
}

INSTANTIATE_TEST_SUITE_P(Studios, StudioFitTest, ::testing::Values(1u, 2u, 3u));

TEST(StudioFitTest, FitsOpenCvAndFisheyeLensesToo) {
  std::vector<CameraCalibration> truth = testing::SeededRig(4);
  truth.resize(3);
  BoardWalk walk;
  walk.moments = 120;
  for (const LensModel model : {LensModel::kOpenCv, LensModel::kFisheye}) {
    const StudioFit fit = Calibrate(truth, walk, model);
    EXPECT_LT(fit.rms_px, 0.25);
    EXPECT_LT(ComparePlacement(fit.bundle.cameras, truth).worst_mm, 12);
  }
}

TEST(StudioFitTest, FindsACameraThatRunsLate) {
  const std::vector<CameraCalibration> truth = [] {
    std::vector<CameraCalibration> rig = testing::SeededRig(5);
    rig.resize(4);
    return rig;
  }();
  // A board that swings smoothly; camera 2 exposes 20 ms after its time stamps.
  BoardWalk walk;
  std::mt19937 random(4);
  const auto pose_at = [&](double t) {
    Matrix3 R;
    R << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    const Matrix3 tilt =
        ExpRotation(Vector3(0.5 * std::sin(1.1 * t), 0.5 * std::cos(0.7 * t), 0.2 * t));
    return RigidTransform{
        tilt * R,
        {900 * std::sin(0.5 * t) - 300, 900 * std::cos(0.37 * t), 1000 + 400 * std::sin(0.9 * t)}};
  };
  BoardDetections detections = testing::DetectionsFor(truth, walk.board);
  detections.timed = true;
  detections.interval_s = 0.1;
  detections.moments = 120;
  constexpr double kLate_s = 0.02;
  for (std::size_t c = 0; c < truth.size(); ++c) {
    for (int m = 0; m < detections.moments; ++m) {
      const double t = 0.1 * m;
      const double exposed = c == 2 ? t + kLate_s : t;
      const auto see = [&](double at) {
        std::mt19937 noise(static_cast<unsigned>(m));
        return testing::SeeBoard(truth[c], truth[c].X_CW, pose_at(at), walk.board, 0, noise);
      };
      const auto now = see(exposed), before = see(exposed - 0.1), after = see(exposed + 0.1);
      if (!now || !before || !after) continue;
      BoardDetection s;
      s.camera = static_cast<int>(c);
      s.moment = m;
      s.corners = *now;
      s.time_s = t;
      for (std::size_t k = 0; k < now->ids.size(); ++k) {
        s.motions.push_back({(after->pixels[k] - before->pixels[k]) / 0.2,
                             (after->pixels[k] - 2 * now->pixels[k] + before->pixels[k]) / 0.01});
      }
      detections.detections.push_back(s);
    }
  }
  const StudioFit fit = FitExtrinsics(detections, truth, {});
  EXPECT_NEAR(fit.bundle.lateness_s[2], kLate_s, 0.001);
  EXPECT_NEAR(fit.bundle.lateness_s[1], 0, 0.001);
  EXPECT_LT(fit.rms_px, 0.1);
}

TEST(StudioFitTest, NamesTheCameraThatSharesNoViews) {
  const std::vector<CameraCalibration> truth = testing::SeededRig(6);
  BoardDetections detections = WalkBoard(truth, {});
  // Camera 4 was recorded on another day.
  for (BoardDetection& s : detections.detections) {
    if (s.camera == 3) s.moment += detections.moments;
  }
  detections.moments *= 2;
  const std::string reason = testing::SetupErrorOf([&] { FitExtrinsics(detections, truth, {}); });
  EXPECT_THAT(reason, HasSubstr("cam4"));
  EXPECT_THAT(reason, HasSubstr("carry the board"));
}

TEST(StudioFitTest, NamesACameraWhoseRecordingIsAnothers) {
  const std::vector<CameraCalibration> truth = testing::SeededRig(7);
  BoardDetections detections = WalkBoard(truth, {});
  // Camera 5's pictures come a few moments late.
  for (BoardDetection& s : detections.detections) {
    if (s.camera == 4) s.moment = (s.moment + 5) % detections.moments;
  }
  EXPECT_THAT(testing::SetupErrorOf([&] { FitExtrinsics(detections, truth, {}); }),
              HasSubstr("cam5"));
}

TEST(StudioFitTest, RefusesABoardThatLooksTheSameTurned) {
  BoardWalk walk;
  walk.board.rows = 6;
  const std::vector<CameraCalibration> truth = testing::SeededRig(8);
  EXPECT_THAT(testing::SetupErrorOf([&] { FitExtrinsics(WalkBoard(truth, walk), truth, {}); }),
              HasSubstr("half a turn"));
}

TEST(StudioFitTest, RefusesTooFewViewsForALens) {
  BoardWalk walk;
  walk.moments = 6;
  const BoardDetections detections = WalkBoard(testing::SeededRig(9), walk);
  EXPECT_THAT(testing::SetupErrorOf([&] { FitLens(detections, 0, {}); }), HasSubstr("cam1"));
}

TEST(StudioFitTest, TellsAWrongBoardSizeByATape) {
  const std::vector<CameraCalibration> truth = testing::SeededRig(10);
  std::vector<CameraCalibration> shrunk = truth;
  for (CameraCalibration& camera : shrunk) camera.X_CW.p *= 0.9;
  const double true_mm = (truth[0].X_CW.Inverse().p - truth[3].X_CW.Inverse().p).norm();
  const KnownDistance distance{"cam1", "cam4", true_mm};
  EXPECT_NEAR(DistanceMm(distance, truth), true_mm, 1e-6);
  EXPECT_NEAR(DistanceMm(distance, shrunk) / true_mm, 0.9, 1e-9);
}

TEST(StudioCheckTest, SeesAFloorThatIsUpsideDown) {
  const std::vector<CameraCalibration> truth = testing::SeededRig(11);
  BoardWalk walk;
  walk.moments = 60;
  StudioFit fit;
  fit.detections = WalkBoard(truth, walk);
  fit.bundle.cameras = truth;
  fit.has_floor = true;
  fit.bundle.X_WB.assign(60, RigidTransform{Matrix3::Identity(), {0, 0, 900}});
  for (const Finding& f : CheckFit(fit)) EXPECT_NE(f.severity, Severity::kWrong) << f.text;
  const RigidTransform over{ExpRotation({std::numbers::pi, 0, 0}), Vector3::Zero()};
  MoveWorld(over, fit.bundle);
  const std::vector<Finding> findings = CheckFit(fit);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].severity, Severity::kWrong);
  EXPECT_THAT(findings[0].text, HasSubstr("below the floor"));
  EXPECT_THAT(Conclusion(findings), HasSubstr("Do not use"));
}

TEST(FloorTest, SetsTheWorldFromThreePoints) {
  const std::vector<CameraCalibration> truth = testing::SeededRig(12);
  StudioFit fit;
  fit.bundle.cameras = truth;
  const RigidTransform away{ExpRotation({0.4, 1.1, -2}), {500, -900, 3000}};
  MoveWorld(away, fit.bundle);
  std::vector<FloorPoint> points;
  const Vector3 places[3] = {{0, 0, 0}, {700, 0, 0}, {0, 500, 0}};
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 6; ++c) {
      const Vector3 p_C = truth[c].X_CW * places[i];
      const auto pixel = PixelFromNormalized(truth[c].lens, p_C.head<2>() / p_C.z());
      if (pixel) points.push_back({c, i, *pixel});
    }
  }
  MoveWorld(WorldOnPoints(points, fit.bundle.cameras), fit.bundle);
  for (int c = 0; c < 6; ++c)
    EXPECT_NEAR((fit.bundle.cameras[c].X_CW.p - truth[c].X_CW.p).norm(), 0, 1e-3);
  for (FloorPoint& point : points) point.point = point.point == 0 ? 0 : 3 - point.point;
  EXPECT_THAT(testing::SetupErrorOf([&] { WorldOnPoints(points, truth); }), HasSubstr("swapped"));
}

}  // namespace
}  // namespace mocap

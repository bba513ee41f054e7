#include "tools/calibration/head_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "core/reconstruction/camera/head_aim.h"
#include "tests/tools/calibration/simulated_board.h"
#include "tools/calibration/floor.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

struct HeadWalk {
  Board board = testing::BoardWalk{}.board;
  double noise_px = 0.15;
  double pan_scale = 1, tilt_scale = 1;
  PanTiltAngles zero;
};

std::vector<CameraCalibration> HeadRig(unsigned seed) {
  simulation::RigOptions options;
  options.pan_tilt = true;
  options.seed = seed;
  return simulation::HangCameras(options);
}

/// A head that looks about while the board lies at four places one after the other.
std::vector<BoardDetection> LookAbout(const CameraCalibration& camera, const HeadWalk& walk) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<BoardDetection> views;
  for (int place = 0; place < 4; ++place) {
    const Vector3 p_C(300 * u(random), 200 * u(random), 2600 + 500 * u(random));
    const Matrix3 tilt = ExpRotation(Vector3(0.5 * u(random), 0.5 * u(random), u(random)));
    const Vector3 corner = walk.board.Corner(walk.board.corners() - 1) / 2;
    const RigidTransform X_WB = camera.X_CW.Inverse() * RigidTransform{tilt, p_C - tilt * corner};
    for (int i = 0; i < 15; ++i) {
      const PanTiltAngles truly{0.28 * u(random), 0.2 * u(random)};
      auto corners =
          testing::SeeBoard(camera, camera.PoseAt(truly), X_WB, walk.board, walk.noise_px, random);
      if (!corners) continue;
      BoardDetection s;
      s.moment = 10 * place;
      s.corners = *corners;
      s.angles = {truly.pan_rad / walk.pan_scale + walk.zero.pan_rad,
                  truly.tilt_rad / walk.tilt_scale + walk.zero.tilt_rad};
      views.push_back(s);
    }
  }
  return views;
}

CameraCalibration WithoutHead(CameraCalibration camera) {
  camera.head.reset();
  return camera;
}

std::string ReasonOf(const CameraCalibration& camera, const std::vector<BoardDetection>& views) {
  try {
    FitHead(camera, {}, testing::BoardWalk{}.board, views);
  } catch (const SetupError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(HeadFitTest, PlacesPointsWithinFourMillimetresAtAnyAngle) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const std::vector<CameraCalibration> truth = HeadRig(seed);
    std::vector<CameraCalibration> found;
    for (const CameraCalibration& camera : truth) {
      const PanTiltFit fit =
          FitHead(WithoutHead(camera), {}, HeadWalk{}.board, LookAbout(camera, {}));
      EXPECT_NEAR(fit.rms_px, 0.15 * std::sqrt(2.0), 0.03);
      EXPECT_NEAR(fit.head.pan_scale, 1, 0.002);
      found.push_back(camera);
      found.back().head = fit.head;
    }
    double worst_mm = 0;
    for (int i = 0; i < 27; ++i) {
      const Vector3 p_W(-1000 + 1000 * (i % 3), -1000 + 1000 * (i / 3 % 3), 200 + 800 * (i / 9));
      std::vector<CameraCalibration> posed = found;
      std::vector<std::pair<const CameraCalibration*, Vector2>> seen;
      for (std::size_t c = 0; c < truth.size(); ++c) {
        const PanTiltAngles angles = AimAt(truth[c], p_W + Vector3(300, -200, 100));
        const Vector3 p_C = truth[c].PoseAt(angles) * p_W;
        posed[c].X_CW = found[c].PoseAt(angles);
        posed[c].head.reset();
        const auto pixel = PixelFromNormalized(truth[c].lens, p_C.head<2>() / p_C.z());
        if (pixel) seen.emplace_back(&posed[c], *pixel);
      }
      worst_mm = std::max(worst_mm, (Triangulate(seen) - p_W).norm());
    }
    EXPECT_LE(worst_mm, 4) << "seed " << seed;
    RecordProperty("worst_mm_" + std::to_string(seed), std::to_string(worst_mm));
  }
}

TEST(HeadFitTest, PosesAreRightWhateverTheEncodersCount) {
  HeadWalk walk;
  walk.pan_scale = 1.03;
  walk.tilt_scale = 0.98;
  walk.zero = {0.4, -0.15};
  const CameraCalibration truth = HeadRig(4)[2];
  const PanTiltFit fit = FitHead(WithoutHead(truth), walk.zero, walk.board, LookAbout(truth, walk));
  EXPECT_NEAR(fit.head.pan_scale, 1.03, 0.002);
  EXPECT_NEAR(fit.head.tilt_scale, 0.98, 0.003);
  CameraCalibration found = truth;
  found.head = fit.head;
  for (const PanTiltAngles& truly : {PanTiltAngles{0.2, 0.1}, {-0.25, -0.15}, {0, 0}}) {
    const PanTiltAngles reading{truly.pan_rad / walk.pan_scale + walk.zero.pan_rad,
                                truly.tilt_rad / walk.tilt_scale + walk.zero.tilt_rad};
    const RigidTransform off = found.PoseAt(reading) * truth.PoseAt(truly).Inverse();
    EXPECT_LT(LogRotation(off.R).norm(), 0.0005);
    EXPECT_LT(off.p.norm(), 2);
  }
}

TEST(HeadFitTest, FindsHeadsThatTurnTheOtherWay) {
  HeadWalk walk;
  walk.pan_scale = walk.tilt_scale = -1;
  const CameraCalibration truth = HeadRig(5)[1];
  const PanTiltFit fit = FitHead(WithoutHead(truth), {}, walk.board, LookAbout(truth, walk));
  EXPECT_LT(fit.head.pan_axis_W.z(), -0.9);
  EXPECT_NEAR(fit.head.pan_scale, 1, 0.002);
}

TEST(HeadFitTest, HeadsThatTurnedWhileTheyWerePosedAreRefused) {
  const std::vector<PanTiltAngles> still = {{0.3, 0.1}, {0.3005, 0.1}, {0.3, 0.1002}};
  EXPECT_EQ(StandingAngles("cam1", still), still[0]);
  const std::vector<PanTiltAngles> turning = {{0.3, 0.1}, {0.32, 0.1}};
  try {
    StandingAngles("cam1", turning);
    FAIL() << "accepted";
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cam1: its head turned by 1.1 degrees"));
  }
}

TEST(HeadFitTest, RefusesWhatDoesNotDetermineAHead) {
  const CameraCalibration camera = HeadRig(5)[0];
  std::vector<BoardDetection> views = LookAbout(camera, {});
  EXPECT_THAT(ReasonOf(WithoutHead(camera), {views.begin(), views.begin() + 5}),
              HasSubstr("cam1: 5 views"));
  std::vector<BoardDetection> unturned = views;
  for (BoardDetection& view : unturned) view.angles.tilt_rad = 0.01;
  EXPECT_THAT(ReasonOf(WithoutHead(camera), unturned), HasSubstr("of tilt only"));
  for (BoardDetection& view : views) std::swap(view.angles.pan_rad, view.angles.tilt_rad);
  EXPECT_THAT(ReasonOf(WithoutHead(camera), views), HasSubstr("no head explains"));
}

}  // namespace
}  // namespace mocap

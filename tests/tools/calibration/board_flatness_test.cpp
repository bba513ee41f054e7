// Corners that lie on no plane are the board's fault, not that of who holds it.
#include "tools/calibration/board_flatness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/support/setup_error.h"
#include "tests/tools/calibration/simulated_board.h"
#include "tools/calibration/lens_fit.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using testing::BoardWalk;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::SetupErrorOf;
using testing::WalkBoard;

BoardWalk ShortWalk(const char* spec = "chess:8x5:100") {
  BoardWalk walk;
  walk.board = ParseBoard(spec);
  walk.moments = 45;
  return walk;
}

std::string WhyUneven(const BoardDetections& detections) {
  return SetupErrorOf([&] { RefuseUneven("carried: cam1", detections, 0); });
}

TEST(BoardFlatnessTest, RowsThatAreNotWhereTheBoardHasThemAreToldOfTheBoard) {
  BoardDetections detections = WalkBoard(simulation::HangCameras({}), ShortWalk());
  for (BoardDetection& s : detections.detections) {
    // Every second row is nearer to the one before.
    for (std::size_t i = 0; i < s.corners.pixels.size(); ++i) {
      if (i / 8 % 2 == 1)
        s.corners.pixels[i] += 0.4 * (s.corners.pixels[i - 8] - s.corners.pixels[i]);
    }
  }
  EXPECT_THAT(WhyUneven(detections),
              AllOf(HasSubstr("carried: cam1: in "), HasSubstr("the corners lie on no plane"),
                    HasSubstr("off in frame "), HasSubstr("8 x 5 inner corners"),
                    HasSubstr("compare it with --board"), Not(HasSubstr("tilt"))));
}

TEST(BoardFlatnessTest, CornersCountedByAnotherNumberOfColumnsAreToldOfTheBoard) {
  BoardDetections detections = WalkBoard(simulation::HangCameras({}), ShortWalk());
  detections.board.columns = 5;
  detections.board.rows = 8;
  EXPECT_THAT(WhyUneven(detections), HasSubstr("the corners lie on no plane"));
}

TEST(BoardFlatnessTest, AGridOfTagsWithOtherGapsIsToldOfTheBoard) {
  BoardDetections detections =
      WalkBoard(simulation::HangCameras({}), ShortWalk("aprilgrid:6x6:88:0.3"));
  detections.board = ParseBoard("aprilgrid:6x6:88:0.6");
  EXPECT_THAT(WhyUneven(detections), HasSubstr("grid of 6 x 6 AprilTags"));
}

TEST(BoardFlatnessTest, BoardsAsDescribedAreFlatWhateverTheLensAndTheNoise) {
  std::vector<CameraCalibration> cameras = simulation::HangCameras({});
  Matrix3 K;
  K << 300, 0, 320, 0, 300, 240, 0, 0, 1;
  for (std::size_t c = 0; c < cameras.size(); c += 2)
    cameras[c].lens = FisheyeLens{K, {0.02, -0.01, 0, 0}};
  for (const char* spec : {"chess:8x5:100", "charuco:5x4:200", "aprilgrid:6x6:88:0.3"}) {
    BoardWalk walk = ShortWalk(spec);
    walk.noise_px = 0.4;
    EXPECT_EQ(WhyUneven(WalkBoard(cameras, walk)), "nothing was thrown") << spec;
  }
}

TEST(BoardFlatnessTest, ALensIsNotAskedOfCornersThatFitNone) {
  BoardDetections detections = WalkBoard(simulation::HangCameras({}), ShortWalk());
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 30);
  for (BoardDetection& s : detections.detections) {
    for (Vector2& pixel : s.corners.pixels) pixel += Vector2(noise(random), noise(random));
  }
  EXPECT_THAT(SetupErrorOf([&] { FitLens(detections, 3, {}); }),
              AllOf(HasSubstr("cam4: no lens explains the corners"), HasSubstr("most in frame"),
                    HasSubstr("the board may be bent"), Not(HasSubstr("tilt"))));
}

}  // namespace
}  // namespace mocap

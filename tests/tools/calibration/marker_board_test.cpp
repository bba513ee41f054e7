// Boards with markers: both layouts of ChArUco, AprilTags, and Kalibr's grids of them.
#include "tools/calibration/marker_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/calibration/marker_board_picture.h"
#include "tools/calibration/board_detector.h"

namespace mocap {
namespace {

using testing::PaintMarkerBoard;

CameraCalibration MarkerCamera() {
  return {"cam1", 640, 480, TsaiLens{6.2, 0.002, 1, {322, 238}, {0.01, 0.01}}, {}, {}};
}

RigidTransform HeldBefore(const Board& board, const Vector3& turn, double distance_mm) {
  const Matrix3 R = ExpRotation(turn);
  const Vector3 middle = (board.Corner(0) + board.Corner(board.corners() - 1)) / 2;
  return {R, Vector3(15, -10, distance_mm) - R * middle};
}

const Vector3 kTurns[] = {{0.1, 0.06, 0.05}, {0.45, -0.3, 0.4}, {-0.4, 0.35, 1.6}, {0.3, 0.4, 3.0}};

struct CornerErrors {
  double mean_px = 0, bias_px = 0;
};

CornerErrors ErrorsOf(const CameraCalibration& camera, const RigidTransform& X_CB,
                      const Board& board, const BoardCorners& found) {
  double sum = 0;
  Vector2 shift = Vector2::Zero();
  for (std::size_t i = 0; i < found.ids.size(); ++i) {
    const Vector3 p_C = X_CB * board.Corner(found.ids[i]);
    const Vector2 off =
        found.pixels[i] - *PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
    sum += off.norm();
    shift += off;
  }
  const auto count = static_cast<double>(found.ids.size());
  return {sum / count, shift.norm() / count};
}

struct MarkerBoardCase {
  const char* name;
  const char* spec;
  bool older_layout;
  double distance_mm;
};

class MarkerBoardTest : public ::testing::TestWithParam<MarkerBoardCase> {};

TEST_P(MarkerBoardTest, FindsCornersWhereTheyAreAndTheLayout) {
  const Board asked = ParseBoard(GetParam().spec);
  Board printed = asked;
  printed.older_layout = GetParam().older_layout;
  const CameraCalibration camera = MarkerCamera();
  for (const Vector3& turn : kTurns) {
    const RigidTransform X_CB = HeldBefore(asked, turn, GetParam().distance_mm);
    const auto found =
        BoardDetector(asked).Detect(PaintMarkerBoard(camera, X_CB, printed).view(), Effort::kQuick);
    ASSERT_TRUE(found) << turn.transpose();
    EXPECT_EQ(found->older_layout, printed.older_layout);
    EXPECT_GT(static_cast<double>(found->ids.size()), 0.8 * asked.corners()) << turn.transpose();
    const CornerErrors errors = ErrorsOf(camera, X_CB, asked, *found);
    EXPECT_LT(errors.mean_px, 0.15) << turn.transpose();
    EXPECT_LT(errors.bias_px, 0.1) << turn.transpose();
  }
}

const MarkerBoardCase kMarkerBoards[] = {
    {"CharucoOfEvenRows", "charuco:7x6:60", false, 750},
    {"CharucoOfEvenRowsInTheOlderLayout", "charuco:7x6:60", true, 750},
    {"CharucoOfEvenSidesInTheOlderLayout", "charuco:6x4:80:DICT_5X5_100:0.7", true, 800},
    {"SmallCharucoInTheOlderLayout", "charuco:4x4:100:DICT_6X6_250:0.7", true, 900},
    {"AprilTags16h5", "charuco:7x5:60:DICT_APRILTAG_16h5", false, 750},
    {"AprilTags25h9SpeltInLowerCase", "charuco:7x5:60:dict_apriltag_25h9", false, 750},
    {"AprilTags36h10SpeltInUpperCase", "charuco:7x5:60:DICT_APRILTAG_36H10", false, 750},
    {"AprilTags36h11InTheOlderLayout", "charuco:7x6:60:DICT_APRILTAG_36h11", true, 750},
    {"AprilGridOfKalibr", "aprilgrid:6x6:55:0.3", false, 850},
    {"AprilGridFarAway", "aprilgrid:6x4:55:0.3", false, 1150},
    {"AprilGridOfNarrowGaps", "aprilgrid:4x5:80:0.2", false, 900}};

constexpr auto kNameOfBoard = [](const ::testing::TestParamInfo<MarkerBoardCase>& info) {
  return std::string(info.param.name);
};

INSTANTIATE_TEST_SUITE_P(Boards, MarkerBoardTest, ::testing::ValuesIn(kMarkerBoards), kNameOfBoard);

TEST(MarkerGridTest, AWideLensDoesNotMakeItAnotherBoard) {
  Matrix3 K;
  K << 260, 0, 318, 0, 260, 242, 0, 0, 1;
  const CameraCalibration camera{"cam1", 640, 480, FisheyeLens{K, {0.02, -0.005, 0, 0}}, {}, {}};
  Board older = ParseBoard("charuco:8x6:60");
  older.older_layout = true;
  for (const Board& printed :
       {older, ParseBoard("charuco:8x6:60"), ParseBoard("aprilgrid:5x4:80:0.3")}) {
    Board asked = printed;
    asked.older_layout = false;
    const RigidTransform X_CB = HeldBefore(asked, {0.5, -0.4, 0.1}, 330);
    const Image<Bgr> picture = PaintMarkerBoard(camera, X_CB, printed);
    const auto found = BoardDetector(asked).Detect(picture.view(), Effort::kQuick);
    ASSERT_TRUE(found) << printed.Text();
    EXPECT_EQ(found->older_layout, printed.older_layout);
    EXPECT_LT(ErrorsOf(camera, X_CB, asked, *found).mean_px, 0.25) << printed.Text();
  }
}

TEST(AprilGridTest, CornersCountFromTheLowerLeftAndPartOfTheGridIsEnough) {
  const Board grid = ParseBoard("aprilgrid:6x5:55:0.3");
  EXPECT_EQ(grid.corners(), 120);
  EXPECT_EQ(grid.Corner(0), Vector3(0, 0, 0));
  EXPECT_NEAR(grid.Corner(1).x(), 55, 1e-9);
  EXPECT_NEAR(grid.Corner(2).x(), 55 * 1.3, 1e-9);
  EXPECT_NEAR(grid.Corner(12).y(), -55, 1e-9);
  EXPECT_NEAR(grid.Corner(24).y(), -55 * 1.3, 1e-9);
  // Half of it is out of the picture.
  const CameraCalibration camera = MarkerCamera();
  RigidTransform X_CB = HeldBefore(grid, {0.2, 0.2, 0}, 500);
  X_CB.p.x() += 250;
  const auto found =
      BoardDetector(grid).Detect(PaintMarkerBoard(camera, X_CB, grid).view(), Effort::kQuick);
  ASSERT_TRUE(found);
  EXPECT_LT(found->ids.size(), 120u);
  EXPECT_LT(ErrorsOf(camera, X_CB, grid, *found).mean_px, 0.15);
}

}  // namespace
}  // namespace mocap

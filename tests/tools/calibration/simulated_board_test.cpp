#include "drivers/simulation/simulated_board.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/virtual_studio/room/printed_board.h"
#include "tools/calibration/board_detector.h"

namespace mocap {
namespace {

const Board kSimulatedBoard{BoardKind::kChessboard,
                            simulation::PrintedBoard::kColumns,
                            simulation::PrintedBoard::kRows,
                            simulation::PrintedBoard::kSquare_mm,
                            "",
                            0,
                            false};

double WorstErrorPx(const CameraCalibration& camera, const RigidTransform& X_WB,
                    const BoardCorners& found) {
  double worst = 0;
  for (std::size_t i = 0; i < found.ids.size(); ++i) {
    const Vector3 p_C = camera.X_CW * (X_WB * kSimulatedBoard.Corner(found.ids[i]));
    const auto pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
    worst = std::max(worst, (*pixel - found.pixels[i]).norm());
  }
  return worst;
}

TEST(SimulatedBoardTest, IsShownToEachCameraInTurnWhereItIs) {
  SimulatedStudioOptions options = RecordedSimulation();
  options.cameras = 4;
  options.fps = 1;
  SimulatedBoard board(options, BoardPlace::kCarried);
  const BoardDetector detector(kSimulatedBoard);
  constexpr double kBetweenCameras_s = 3 * (simulation::kMoveBoard_s + simulation::kHoldBoard_s);
  for (int camera = 0; camera < options.cameras; ++camera) {
    const auto frame = static_cast<std::int64_t>(kBetweenCameras_s * camera);
    const auto found = detector.Detect(board.Paint(camera, frame), Effort::kQuick);
    ASSERT_TRUE(found) << camera;
    const RigidTransform X_WB = board.PoseAt(board.CaptureTime(camera, frame));
    EXPECT_LT(WorstErrorPx(board.cameras()[camera], X_WB, *found), 0.5) << camera;
  }
}

TEST(SimulatedBoardTest, LiesWhereTheWorldIs) {
  SimulatedBoard board(RecordedSimulation(), BoardPlace::kOnFloor);
  const RigidTransform X_WB = board.PoseAt(0);
  EXPECT_LT((X_WB * kSimulatedBoard.Corner(0)).norm(), 1e-9);
  EXPECT_LT((X_WB * kSimulatedBoard.Corner(1) - Vector3(100, 0, 0)).norm(), 1e-9);
  const auto found = BoardDetector(kSimulatedBoard).Detect(board.Paint(0, 0), Effort::kThorough);
  ASSERT_TRUE(found);
  EXPECT_LT(WorstErrorPx(board.cameras()[0], X_WB, *found), 0.7);
}

}  // namespace
}  // namespace mocap

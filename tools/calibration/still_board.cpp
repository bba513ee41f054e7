#include "tools/calibration/still_board.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.h"
#include "tools/calibration/board_pose.h"
#include "tools/calibration/floor.h"
#include "tools/calibration/floor_matcher.h"

namespace mocap {
namespace {

constexpr double kLeastAgreement = 0.15, kLeastLead = 0.05;

// Numbers the corners from the other end.
void Turn(BoardCorners& corners) { std::reverse(corners.pixels.begin(), corners.pixels.end()); }

void SettleTurns(const std::vector<CameraCalibration>& lenses,
                 const std::vector<Image<Bgr>>& pictures, BoardDetections& still) {
  std::vector<FloorView> views;
  for (const BoardDetection& s : still.detections) {
    const std::vector<BoardPose> poses =
        FindBoardPoses(lenses[s.camera].lens, still.board, s.corners);
    if (poses.empty())
      throw SetupError(lenses[s.camera].name + ": its lens does not explain the board it sees");
    views.push_back({&pictures[s.camera], &lenses[s.camera].lens, poses.front().X_CB});
  }
  const FloorTurns turns = MatchFloors(views, still.board);
  if (views.size() > 1 &&
      (turns.agreement < kLeastAgreement || turns.agreement < turns.runner_up + kLeastLead))
    throw SetupError(
        fmt::format("--board: a {} looks the same when it is turned by half a turn, and the floor "
                    "around it does not tell (agreement {:.2f}, next best {:.2f}); expected a "
                    "board with an odd and an even side, or a ChArUco board",
                    still.board.Text(), turns.agreement, turns.runner_up));
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (turns.turned[i]) Turn(still.detections[i].corners);
  }
}

}  // namespace

StudioFit FitToStillBoard(const BoardDetections& still,
                          const std::vector<CameraCalibration>& lenses,
                          const std::vector<Image<Bgr>>& pictures, double thickness_mm) {
  StudioFit fit;
  fit.detections = still;
  if (still.board.LooksSameTurned()) SettleTurns(lenses, pictures, fit.detections);
  fit.bundle.cameras = lenses;
  fit.bundle.X_WB = {RigidTransform{}};
  for (const BoardDetection& s : fit.detections.detections) {
    const std::vector<BoardPose> poses =
        FindBoardPoses(lenses[s.camera].lens, still.board, s.corners);
    if (poses.empty())
      throw SetupError(lenses[s.camera].name + ": its lens does not explain the board it sees");
    fit.bundle.cameras[s.camera].X_CW = poses.front().X_CB;
  }
  MoveWorld(WorldOnBoard({}, fit.bundle.cameras, thickness_mm), fit.bundle);
  fit.has_floor = true;
  MeasureFit(fit);
  return fit;
}

}  // namespace mocap

// Calibration from pictures of boards with markers, from the recording to the world.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "drivers/take/video_writer.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tests/tools/calibration/marker_board_picture.h"
#include "tests/tools/calibration/simulated_board.h"
#include "tools/calibrate_steps.h"
#include "tools/calibration/floor.h"
#include "tools/calibration/placement.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::SetupErrorOf;

/// Recordings of a board that is held before one camera.
class MarkerRecordingTest : public ::testing::Test {
 protected:
  MarkerRecordingTest() {
    arguments_.footage = folder_.path() / "carried";
    std::filesystem::create_directory(arguments_.footage);
  }

  void Record(const Board& printed, int views) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1, 1);
    const Vector3 first = printed.Corner(0), last = printed.Corner(printed.corners() - 1);
    VideoWriter writer(arguments_.footage / "cam1.mkv", camera_.width_px, camera_.height_px, 10,
                       VideoPixels::kBgr);
    for (int i = 0; i < views; ++i) {
      const Matrix3 R = ExpRotation({0.5 * u(random), 0.5 * u(random), 0.3 * u(random)});
      const Vector3 middle = Vector3(0.3 * u(random), 0.2 * u(random), 2.2 + 0.4 * u(random));
      const RigidTransform X_CB{R, (last - first).norm() * middle - R * (first + last) / 2};
      writer.Write(testing::PaintMarkerBoard(camera_, X_CB, printed).view());
    }
    writer.Finish();
  }

  double FocalLengthPx(const std::string& board) {
    arguments_.board = board;
    fit_ = CalibrateIntrinsics(arguments_);
    return std::get<OpenCvLens>(fit_.bundle.cameras[0].lens).K(0, 0);
  }

  std::string Refusal(const std::string& board) {
    arguments_.board = board;
    return SetupErrorOf([this] { CalibrateIntrinsics(arguments_); });
  }

  testing::TemporaryFolder folder_;
  CalibrateArguments arguments_;
  StudioFit fit_;
  // 600 px.
  const CameraCalibration camera_{"cam1", 640, 480, TsaiLens{6.0, 0, 1, {322, 238}, {0.01, 0.01}},
                                  {},     {}};
};

TEST_F(MarkerRecordingTest, ALensIsFoundFromTheOlderLayoutAndThatIsSaid) {
  Board printed = ParseBoard("charuco:7x6:60");
  printed.older_layout = true;
  Record(printed, 14);
  EXPECT_NEAR(FocalLengthPx("charuco:7x6:60"), 600, 4);
  EXPECT_LT(fit_.rms_px, 0.3);
  EXPECT_THAT(FitText(fit_, {}), HasSubstr("in the older layout of before OpenCV 4.6"));
}

TEST_F(MarkerRecordingTest, ViewsThatFitBothLayoutsAreOfTheOneThatOthersShow) {
  Board board = ParseBoard("charuco:7x6:60");
  for (const bool older : {false, true}) {
    board.older_layout = older;
    VideoWriter writer(arguments_.footage / "cam1.mkv", camera_.width_px, camera_.height_px, 10,
                       VideoPixels::kBgr);
    std::vector<RigidTransform> poses;
    // Without the outer columns on the right and on the left, and whole.
    for (const double x_mm : {120., -420., -150., -150., -420.}) {
      const double turn = 0.05 * static_cast<double>(poses.size());
      poses.push_back({ExpRotation({0.1, turn, turn}), Vector3(x_mm, -100, 560)});
      writer.Write(testing::PaintMarkerBoard(camera_, poses.back(), board).view());
    }
    writer.Finish();
    const BoardDetections found =
        CollectDetections(OpenFootage(arguments_.footage), ParseBoard("charuco:7x6:60"), {});
    EXPECT_EQ(found.board.older_layout, older);
    ASSERT_EQ(found.detections.size(), 5u);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const BoardCorners& corners = found.detections[i].corners;
      for (std::size_t k = 0; k < corners.ids.size(); ++k) {
        const Vector3 p_C = poses[i] * board.Corner(corners.ids[k]);
        EXPECT_LT((*PixelFromNormalized(camera_.lens, p_C.head<2>() / p_C.z()) - corners.pixels[k])
                      .norm(),
                  0.6)
            << older << " " << i << " " << corners.ids[k];
      }
    }
  }
}

TEST_F(MarkerRecordingTest, ALensIsFoundFromAprilTagsAndNoOtherLayoutIsSaid) {
  Record(ParseBoard("charuco:7x6:60:DICT_APRILTAG_36h11"), 14);
  EXPECT_NEAR(FocalLengthPx("charuco:7x6:60:DICT_APRILTAG_36H11"), 600, 4);
  EXPECT_THAT(FitText(fit_, {}), Not(HasSubstr("older layout")));
}

TEST_F(MarkerRecordingTest, ALensIsFoundFromKalibrsGrid) {
  Record(ParseBoard("aprilgrid:6x5:88:0.3"), 14);
  EXPECT_NEAR(FocalLengthPx("aprilgrid:6x5:88:0.3"), 600, 4);
  const OpenCvLens& lens = std::get<OpenCvLens>(fit_.bundle.cameras[0].lens);
  EXPECT_NEAR(lens.K(0, 2), 322, 4);
  EXPECT_NEAR(lens.K(1, 2), 238, 4);
  EXPECT_LT(fit_.rms_px, 0.3);
  EXPECT_THAT(FitText(fit_, {}), HasSubstr("grid of 6 x 5 AprilTags of 88 mm, gaps of 26.4 mm"));
}

TEST_F(MarkerRecordingTest, ColumnsAndRowsExchangedAreNotToldOfTheHandling) {
  Record(ParseBoard("charuco:6x7:60"), 3);
  EXPECT_THAT(Refusal("charuco:7x6:60"),
              AllOf(HasSubstr("cam1: frame "), HasSubstr("looks like charuco:6x7:60"),
                    HasSubstr("not charuco:7x6:60"), Not(HasSubstr("tilt"))));
  EXPECT_THAT(Refusal("chess:6x5:60"), HasSubstr("looks like charuco:6x7:MM"));
}

TEST_F(MarkerRecordingTest, AnotherBoardOnTheFloorIsNamed) {
  Record(ParseBoard("charuco:5x4:60"), 1);
  StudioFit fit;
  fit.bundle.cameras = {camera_};
  arguments_.floor = arguments_.footage;
  arguments_.board = "charuco:7x6:60";
  EXPECT_THAT(SetupErrorOf([&] { SetWorld(arguments_, fit); }),
              AllOf(HasSubstr("cam1: frame 0"), HasSubstr("looks like charuco:5x4:60")));
}

TEST(AprilGridStudioTest, PlacesCamerasAndTheFloorWithYUpTheGrid) {
  const std::vector<CameraCalibration> truth = testing::SeededRig(2);
  testing::BoardWalk walk;
  walk.board = ParseBoard("aprilgrid:6x6:88:0.3");
  walk.moments = 120;
  StudioFit fit = FitExtrinsics(testing::WalkBoard(truth, walk), truth, {});
  // On the floor, printed side up, its first corner at the origin.
  Matrix3 R;
  R << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  const BoardDetections floor =
      testing::SeeStillBoard(truth, walk.board, {R, Vector3(0, 0, 0)}, walk.noise_px / 2);
  ASSERT_GE(floor.detections.size(), 2u);
  const RigidTransform X_WB = FindStillBoard(floor, fit.bundle.cameras);
  MoveWorld(WorldOnBoard(X_WB, fit.bundle.cameras, 0), fit.bundle);
  // The grid's y is negative, up the grid; the world's is not.
  EXPECT_LT(walk.board.Corner(walk.board.corners() - 1).y(), 0);
  EXPECT_LT(ComparePlacement(fit.bundle.cameras, truth).worst_mm, 8);
  for (std::size_t c = 0; c < truth.size(); ++c) {
    const Vector3 at = fit.bundle.cameras[c].X_CW.Inverse().p, true_at = truth[c].X_CW.Inverse().p;
    EXPECT_LT((at - true_at).norm(), 25) << truth[c].name;
  }
}

}  // namespace
}  // namespace mocap

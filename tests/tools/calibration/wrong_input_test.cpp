// What a person may do wrong: each ends with a line that names what it was and what to do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/errors.h"
#include "drivers/calibration_file.h"
#include "drivers/video_writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/tools/calibration/board_picture.h"
#include "tests/tools/calibration/simulated_board.h"
#include "tools/calibrate_steps.h"
#include "tools/calibration/floor.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using testing::BoardWalk;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::WalkBoard;
using testing::WriteText;

std::string ReasonOf(const std::function<void()>& step) {
  try {
    step();
  } catch (const SetupError& error) {
    return error.what();
  }
  return "accepted";
}

std::vector<CameraCalibration> Rig() { return simulation::HangCameras({}); }

void WriteVideo(const std::filesystem::path& file, const Image<Bgr>& picture, int frames) {
  VideoWriter writer(file, picture.width(), picture.height(), 10, VideoPixels::kBgr);
  for (int i = 0; i < frames; ++i) writer.Write(picture.view());
  writer.Finish();
}

/// Two cameras that see the board, and one picture over and over.
class WrongFootageTest : public ::testing::Test {
 protected:
  WrongFootageTest() {
    arguments_.footage = folder_.path() / "footage";
    arguments_.board = "chess:8x5:100";
    std::filesystem::create_directory(arguments_.footage);
    const Matrix3 R = ExpRotation({0.3, 0.2, 0.1});
    seen_ = testing::PaintBoard(camera_, {R, Vector3(0, 0, 1900) - R * Vector3(350, 200, 0)},
                                BoardWalk{}.board);
  }

  void Write(const std::string& camera, const Image<Bgr>& picture, int frames = 2) {
    WriteVideo(arguments_.footage / (camera + ".mkv"), picture, frames);
  }
  void WriteIntrinsics(int width, const std::string& second_name) {
    CameraCalibration a = camera_, b = camera_;
    a.name = "cam1";
    b.name = second_name;
    b.width_px = width;
    arguments_.intrinsics = folder_.path() / "lenses.toml";
    WriteCalibration(arguments_.intrinsics, std::vector<CameraCalibration>{a, b});
  }
  std::string Intrinsics() {
    return ReasonOf([this] { CalibrateIntrinsics(arguments_); });
  }
  std::string Extrinsics() {
    return ReasonOf([this] { CalibrateExtrinsics(arguments_); });
  }

  TemporaryFolder folder_;
  CalibrateArguments arguments_;
  CameraCalibration camera_ = Rig()[0];
  Image<Bgr> seen_;
  const Image<Bgr> empty_{640, 480, Bgr{120, 120, 120}};
};

TEST_F(WrongFootageTest, NoFolder) {
  arguments_.footage = folder_.path() / "missing";
  EXPECT_THAT(Intrinsics(), AllOf(HasSubstr("missing"), HasSubstr("is no folder")));
}

TEST_F(WrongFootageTest, NothingInTheFolder) { EXPECT_THAT(Intrinsics(), HasSubstr("cam1.mkv")); }

TEST_F(WrongFootageTest, APictureThatIsNone) {
  WriteText(arguments_.footage / "a.png", "not a picture");
  EXPECT_THAT(Intrinsics(), HasSubstr("a.png: is no picture"));
}

TEST_F(WrongFootageTest, ACameraThatSeesNoBoard) {
  Write("cam1", seen_);
  Write("cam2", empty_);
  EXPECT_THAT(Intrinsics(), AllOf(HasSubstr("cam2 sees no board"), HasSubstr("8 x 5 inner corners"),
                                  HasSubstr("sharp")));
}

TEST_F(WrongFootageTest, ABoardOfAnotherSize) {
  Write("cam1", seen_);
  arguments_.board = "chess:9x6:100";
  EXPECT_THAT(Intrinsics(), AllOf(HasSubstr("cam1 sees no board"), HasSubstr("9 x 6")));
}

TEST_F(WrongFootageTest, ABlurredBoard) {
  Image<Bgr> blurred = seen_;
  for (int y = 20; y < 460; ++y) {
    for (int x = 20; x < 620; ++x) {
      int sum = 0;
      for (int i = 0; i < 49; ++i) sum += seen_(x + 2 * (i % 7) - 6, y + 2 * (i / 7) - 6).g;
      const auto mean = static_cast<std::uint8_t>(sum / 49);
      blurred(x, y) = {mean, mean, mean};
    }
  }
  Write("cam1", blurred);
  EXPECT_THAT(Intrinsics(), AllOf(HasSubstr("cam1 sees no board"), HasSubstr("sharp")));
}

TEST_F(WrongFootageTest, TooFewViews) {
  Write("cam1", seen_, 3);
  EXPECT_THAT(Intrinsics(), AllOf(HasSubstr("cam1: 3 views"), HasSubstr("tilted")));
}

TEST_F(WrongFootageTest, AlwaysTheSameView) {
  Write("cam1", seen_, 8);
  EXPECT_THAT(Intrinsics(), AllOf(HasSubstr("cam1: its 8 views"), HasSubstr("tilt the board")));
}

TEST_F(WrongFootageTest, LensesOfAnotherResolution) {
  Write("cam1", seen_);
  Write("cam2", seen_);
  WriteIntrinsics(1280, "cam2");
  EXPECT_THAT(Extrinsics(), AllOf(HasSubstr("cam2 is calibrated for 1280 x 480"),
                                  HasSubstr("its footage is 640 x 480")));
}

TEST_F(WrongFootageTest, LensesOfOtherCameras) {
  Write("cam1", seen_);
  Write("cam2", seen_);
  WriteIntrinsics(640, "cam7");
  EXPECT_THAT(Extrinsics(), HasSubstr("has no camera \"cam2\""));
}

TEST_F(WrongFootageTest, TooFewSharedViews) {
  Write("cam1", seen_);
  Write("cam2", seen_);
  WriteIntrinsics(640, "cam2");
  EXPECT_THAT(Extrinsics(), AllOf(HasSubstr("cam2: shares fewer"), HasSubstr("carry the board")));
}

TEST_F(WrongFootageTest, AFloorOfCamerasThatAreNotCalibrated) {
  Write("cam9", seen_);
  StudioFit fit;
  fit.bundle.cameras = {camera_};
  arguments_.floor = arguments_.footage;
  EXPECT_THAT(ReasonOf([&] { SetWorld(arguments_, fit); }),
              HasSubstr("\"cam9\" that is not calibrated"));
}

TEST(WrongSightingsTest, AMirroredPicture) {
  BoardSightings sightings = WalkBoard(Rig(), {});
  for (BoardSighting& s : sightings.sightings) {
    if (s.camera != 2) continue;
    // As the detector names the corners of a mirrored picture.
    for (Vector2& pixel : s.corners.pixels) pixel.x() = 639 - pixel.x();
    for (int row = 0; row < 5; ++row)
      std::reverse(s.corners.pixels.begin() + 8 * row, s.corners.pixels.begin() + 8 * row + 8);
  }
  EXPECT_THAT(ReasonOf([&] { FitExtrinsics(sightings, Rig(), {}); }),
              AllOf(HasSubstr("cam3"), HasSubstr("mirrored")));
}

TEST(WrongSightingsTest, TwoRecordingsSwapped) {
  BoardSightings sightings = WalkBoard(Rig(), {});
  for (BoardSighting& s : sightings.sightings) {
    if (s.camera == 1) s.moment = (s.moment + 40) % sightings.moments;
  }
  EXPECT_THAT(ReasonOf([&] { FitExtrinsics(sightings, Rig(), {}); }), HasSubstr("cam2"));
}

TEST(WrongSightingsTest, RowsAndColumnsThatFitNoLens) {
  BoardSightings sightings = WalkBoard(Rig(), {});
  sightings.board.columns = 5;
  sightings.board.rows = 8;
  EXPECT_THAT(ReasonOf([&] { FitLens(sightings, 3, {}); }), HasSubstr("cam4"));
}

TEST(WrongSightingsTest, AFloorBoardThatWasMoved) {
  const BoardWalk walk;
  BoardSightings still =
      testing::SeeStillBoard(Rig(), walk.board, testing::BoardOnFloor(), walk.noise_px);
  ASSERT_GE(still.sightings.size(), 3u);
  for (Vector2& pixel : still.sightings[1].corners.pixels) pixel.x() += 25;
  EXPECT_THAT(ReasonOf([&] { FindStillBoard(still, Rig()); }),
              AllOf(HasSubstr(Rig()[static_cast<std::size_t>(still.sightings[1].camera)].name),
                    HasSubstr("was it moved")));
}

TEST(WrongWorldTest, AFloorPointThatOneCameraSees) {
  const std::vector<FloorPoint> points = {{0, 0, {1, 1}}, {1, 0, {1, 1}}, {0, 1, {5, 5}}};
  EXPECT_THAT(ReasonOf([&] { WorldOnPoints(points, Rig()); }),
              AllOf(HasSubstr("\"x\""), HasSubstr("two at least")));
}

TEST(WrongWorldTest, ATableOfFloorPointsWithAnUnknownCamera) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "points.csv";
  WriteText(file, "point,camera,x_px,y_px\norigin,cam1,3,4\nx,cam77,3,4\n");
  EXPECT_THAT(ReasonOf([&] { ReadFloorPoints(file.string(), Rig()); }), HasSubstr("points.csv:3"));
}

TEST(WrongWorldTest, ABoardOfAnotherSizeThanTyped) {
  CalibrateArguments arguments;
  StudioFit fit;
  fit.bundle.cameras = Rig();
  fit.bundle.X_WB = {RigidTransform{}};
  fit.has_floor = true;
  const double true_mm = DistanceMm({"cam1", "cam4", 1}, fit.bundle.cameras);
  arguments.distance = "cam1:cam4:" + std::to_string(true_mm * 0.9);
  const std::vector<Finding> findings = CheckAll(arguments, fit);
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings[0].text, AllOf(HasSubstr("cam1 and cam4"), HasSubstr("0.90 times")));
  arguments.distance = "cam1:cam4";
  EXPECT_THAT(ReasonOf([&] { CheckAll(arguments, fit); }), HasSubstr("CAMERA:CAMERA:MM"));
}

TEST(WrongWorldTest, LengthsInMetres) {
  std::vector<CameraCalibration> cameras = Rig();
  for (CameraCalibration& camera : cameras) camera.X_CW.p /= 1000;
  const std::vector<Finding> findings = CheckCameras(cameras, true);
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings[0].text, HasSubstr("metres"));
}

TEST(WrongWorldTest, AMirroredCalibration) {
  std::vector<CameraCalibration> cameras = Rig();
  cameras[2].X_CW.R.col(0) *= -1;
  EXPECT_THAT(CheckCameras(cameras, true)[0].text, AllOf(HasSubstr("cam3"), HasSubstr("mirrored")));
}

}  // namespace
}  // namespace mocap

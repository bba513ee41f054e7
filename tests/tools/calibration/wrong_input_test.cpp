// What a person may do wrong: each ends with one line that names camera and frame, where there is
// one, and what to do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/core.hpp>

#include "core/errors.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/video_writer.h"
#include "drivers/virtual_studio/room/printed_board.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tests/tools/calibration/board_picture.h"
#include "tests/tools/calibration/simulated_board.h"
#include "tools/calibrate_steps.h"
#include "tools/calibration/floor.h"
#include "tools/calibration/head_fit.h"

namespace mocap {
namespace {

using testing::BoardWalk;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;
using testing::WalkBoard;
using testing::WriteText;

std::string FirstOf(const std::vector<Finding>& findings) {
  return findings.empty() ? "accepted" : findings[0].text;
}

std::vector<CameraCalibration> Rig() { return simulation::HangCameras({}); }

Image<Bgr> Blurred(const Image<Bgr>& sharp) {
  Image<Bgr> blurred = sharp;
  for (int y = 20; y < 460; ++y) {
    for (int x = 20; x < 620; ++x) {
      int sum = 0;
      for (int i = 0; i < 49; ++i) sum += sharp(x + 2 * (i % 7) - 6, y + 2 * (i / 7) - 6).g;
      const auto mean = static_cast<std::uint8_t>(sum / 49);
      blurred(x, y) = {mean, mean, mean};
    }
  }
  return blurred;
}

/// A ChArUco board of 5 x 4 squares that fills most of a picture.
Image<Bgr> Charuco() {
  const auto board = cv::aruco::CharucoBoard::create(
      5, 4, 40, 30, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50));
  cv::Mat drawn;
  board->draw(cv::Size(500, 400), drawn, 20);
  Image<Bgr> picture(640, 480, Bgr{120, 120, 120});
  for (int y = 0; y < drawn.rows; ++y) {
    for (int x = 0; x < drawn.cols; ++x) {
      const std::uint8_t value = drawn.at<std::uint8_t>(y, x);
      picture(x + 70, y + 40) = {value, value, value};
    }
  }
  return picture;
}

Image<Bgr> Changed(const Image<Bgr>& picture, bool mirrored, bool inverted) {
  Image<Bgr> changed = picture;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const std::uint8_t value = picture(mirrored ? picture.width() - 1 - x : x, y).g;
      const auto g = static_cast<std::uint8_t>(inverted ? 255 - value : value);
      changed(x, y) = {g, g, g};
    }
  }
  return changed;
}

/// A Windows bitmap of one colour.
void WriteBitmap(const std::filesystem::path& file, std::int32_t width, std::int32_t height) {
  std::ofstream out(file, std::ios::binary);
  const auto number = [&out](auto value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  out << "BM";
  for (const std::int32_t n : {54 + 3 * width * height, 0, 54, 40, width, height}) number(n);
  for (const std::int16_t n : {1, 24}) number(n);
  for (const std::int32_t n : {0, 3 * width * height, 0, 0, 0, 0}) number(n);
  out << std::string(static_cast<std::size_t>(3) * width * height, 'x');
}

/// A folder for footage, and pictures of a board to put there.
struct Bench {
  Bench() {
    arguments.footage = folder.path() / "footage";
    arguments.board = "chess:8x5:100";
    std::filesystem::create_directory(arguments.footage);
    const Matrix3 R = ExpRotation({0.3, 0.2, 0.1});
    seen = testing::PaintBoard(camera, {R, Vector3(0, 0, 1900) - R * Vector3(350, 200, 0)},
                               BoardWalk{}.board);
  }

  void Write(const std::string& name, const Image<Bgr>& picture, int frames = 2) const {
    VideoWriter writer(arguments.footage / (name + ".mkv"), picture.width(), picture.height(), 10,
                       VideoPixels::kBgr);
    for (int i = 0; i < frames; ++i) writer.Write(picture.view());
    writer.Finish();
  }
  void WriteIntrinsics(int width, const std::string& second_name) {
    CameraCalibration a = camera, b = camera;
    a.name = "cam1";
    b.name = second_name;
    b.width_px = width;
    arguments.intrinsics = folder.path() / "lenses.toml";
    WriteCalibration(arguments.intrinsics, std::vector<CameraCalibration>{a, b});
  }
  std::string Intrinsics() const {
    return testing::SetupErrorOf([this] { CalibrateIntrinsics(arguments); });
  }
  std::string Extrinsics() const {
    return testing::SetupErrorOf([this] { CalibrateExtrinsics(arguments); });
  }

  TemporaryFolder folder;
  CalibrateArguments arguments;
  CameraCalibration camera = Rig()[0];
  Image<Bgr> seen;
  const Image<Bgr> empty{640, 480, Bgr{120, 120, 120}};
};

struct WrongInput {
  const char* name;
  std::string (*reason)(Bench&);
  /// What, where, and what to do.
  std::vector<std::string> says;
};

class WrongInputTest : public ::testing::TestWithParam<WrongInput> {};

TEST_P(WrongInputTest, EndsWithALineThatNamesItAndTheRemedy) {
  Bench bench;
  const std::string reason = GetParam().reason(bench);
  for (const std::string& words : GetParam().says) EXPECT_THAT(reason, HasSubstr(words));
  EXPECT_THAT(reason, Not(HasSubstr("\n")));
}

const WrongInput kWrongRecordings[] = {
    {"NoFolder",
     [](Bench& b) {
       b.arguments.footage = b.folder.path() / "missing";
       return b.Intrinsics();
     },
     {"missing: not found", "expected a take or a folder of recordings"}},
    {"NothingInTheFolder", [](Bench& b) { return b.Intrinsics(); }, {"footage", "cam1.mkv"}},
    {"APictureThatIsNone",
     [](Bench& b) {
       WriteText(b.arguments.footage / "a.png", "not a picture");
       return b.Intrinsics();
     },
     {"a.png", "is not a readable picture", "remove it"}},
    {"PicturesOfTwoSizes",
     [](Bench& b) {
       WriteBitmap(b.arguments.footage / "a.bmp", 640, 480);
       WriteBitmap(b.arguments.footage / "b.bmp", 320, 240);
       return b.Intrinsics();
     },
     {"b.bmp", "320 x 240", "640 x 480", "one resolution"}},
    {"ACameraThatSeesNoBoard",
     [](Bench& b) {
       b.Write("cam1", b.seen);
       b.Write("cam2", b.empty);
       return b.Intrinsics();
     },
     {"cam2 sees no board", "2 frames", "8 x 5 inner corners", "show all of it, sharp"}},
    {"SquaresCountedForCorners",
     [](Bench& b) {
       b.Write("cam1", b.seen);
       b.arguments.board = "chess:9x6:100";
       return b.Intrinsics();
     },
     {"cam1: frame 0", "looks like chess:8x5:100, not chess:9x6:100", "inner corners"}},
    {"ABlurredBoard",
     [](Bench& b) {
       b.Write("cam1", Blurred(b.seen));
       return b.Intrinsics();
     },
     {"cam1: frame 0", "blurred", "hold it still"}},
    {"AMirroredBoard",
     [](Bench& b) {
       b.arguments.board = "charuco:5x4:40";
       b.Write("cam1", Changed(Charuco(), true, false));
       return b.Intrinsics();
     },
     {"cam1: frame 0", "mirrored", "switch mirroring off"}},
    {"ABoardPrintedWhiteOnBlack",
     [](Bench& b) {
       b.arguments.board = "charuco:5x4:40";
       b.Write("cam1", Changed(Charuco(), false, true));
       return b.Intrinsics();
     },
     {"cam1: frame 0", "white on black", "add :inverted"}},
    {"TooFewViews",
     [](Bench& b) {
       b.Write("cam1", b.seen, 3);
       return b.Intrinsics();
     },
     {"cam1: 3 views", "frame 0 to frame 2", "tilted"}},
    {"AlwaysTheSameView",
     [](Bench& b) {
       b.Write("cam1", b.seen, 8);
       return b.Intrinsics();
     },
     {"cam1: its 8 views", "frame 0 to frame 7", "tilt the board"}},
    {"AWandForALens",
     [](Bench& b) {
       b.arguments.board = "wand:500";
       return b.Intrinsics();
     },
     {"wand:500", "does not determine intrinsics", "use a board"}},
    {"LensesOfAnotherResolution",
     [](Bench& b) {
       b.Write("cam1", b.seen);
       b.Write("cam2", b.seen);
       b.WriteIntrinsics(1280, "cam2");
       return b.Extrinsics();
     },
     {"cam2 is calibrated for 1280 x 480", "its footage is 640 x 480", "calibrate its lens"}},
    {"LensesOfOtherCameras",
     [](Bench& b) {
       b.Write("cam1", b.seen);
       b.Write("cam2", b.seen);
       b.WriteIntrinsics(640, "cam7");
       return b.Extrinsics();
     },
     {"lenses.toml", "has no camera \"cam2\"", "expected one of cam1, cam7"}},
    {"TooFewSharedViews",
     [](Bench& b) {
       b.Write("cam1", b.seen);
       b.Write("cam2", b.seen);
       b.WriteIntrinsics(640, "cam2");
       return b.Extrinsics();
     },
     {"cam2: fewer than", "carry the board"}},
    {"AFloorOfCamerasThatAreNotCalibrated",
     [](Bench& b) {
       b.Write("cam9", b.seen);
       StudioFit fit;
       fit.bundle.cameras = {b.camera};
       b.arguments.floor = b.arguments.footage;
       return testing::SetupErrorOf([&] { SetWorld(b.arguments, fit); });
     },
     {"\"cam9\" that is not calibrated", "cam1"}},
};

const WrongInput kWrongDetections[] = {
    {"AMirroredCamera",
     [](Bench&) {
       BoardDetections detections = WalkBoard(Rig(), {});
       for (BoardDetection& s : detections.detections) {
         if (s.camera != 2) continue;
         // As the detector names the corners of a mirrored picture.
         for (Vector2& pixel : s.corners.pixels) pixel.x() = 639 - pixel.x();
         for (int row = 0; row < 5; ++row)
           std::reverse(s.corners.pixels.begin() + 8 * row, s.corners.pixels.begin() + 8 * row + 8);
       }
       return testing::SetupErrorOf([&] { FitExtrinsics(detections, Rig(), {}); });
     },
     {"cam3: contradicts", "not frame", "mirrored"}},
    {"ARecordingOfAnotherTime",
     [](Bench&) {
       BoardDetections detections = WalkBoard(Rig(), {});
       for (BoardDetection& s : detections.detections) {
         if (s.camera == 1) s.moment = (s.moment + 40) % detections.moments;
       }
       return testing::SetupErrorOf([&] { FitExtrinsics(detections, Rig(), {}); });
     },
     {"cam2: contradicts", "not frame", "record all cameras at once"}},
    {"ABoardThatLooksTheSameTurned",
     [](Bench&) {
       BoardWalk walk;
       walk.board.rows = 6;
       return testing::SetupErrorOf([&] { FitExtrinsics(WalkBoard(Rig(), walk), Rig(), {}); });
     },
     {"8 x 6", "half a turn", "one side odd and the other even"}},
    {"RowsAndColumnsThatFitNoLens",
     [](Bench&) {
       BoardDetections detections = WalkBoard(Rig(), {});
       detections.board.columns = 5;
       detections.board.rows = 8;
       return testing::SetupErrorOf([&] { FitLens(detections, 3, {}); });
     },
     {"cam4: ", "most in frame", "columns and rows swapped"}},
    {"AFloorBoardThatWasMoved",
     [](Bench&) {
       const BoardWalk walk;
       BoardDetections still =
           testing::SeeStillBoard(Rig(), walk.board, simulation::BoardOnFloor(), walk.noise_px);
       still.detections[1].camera = 1;
       for (Vector2& pixel : still.detections[1].corners.pixels) pixel.x() += 25;
       return testing::SetupErrorOf([&] { FindStillBoard(still, Rig()); });
     },
     {"cam2: sees the floor's board", "was moved while", "record it again"}},
    {"AHeadThatTurned",
     [](Bench&) {
       const std::vector<PanTiltAngles> readings = {{0.3, 0.1}, {0.32, 0.1}};
       return testing::SetupErrorOf([&] { StandingAngles("cam4", readings); });
     },
     {"cam4: its head turned", "keep heads still"}},
};

const WrongInput kWrongWorlds[] = {
    {"AFloorPointThatOneCameraSees",
     [](Bench&) {
       const std::vector<FloorPoint> points = {{0, 0, {1, 1}}, {1, 0, {1, 1}}, {0, 1, {5, 5}}};
       return testing::SetupErrorOf([&] { WorldOnPoints(points, Rig()); });
     },
     {"\"x\"", "at least two"}},
    {"ATableOfFloorPointsWithAnUnknownCamera",
     [](Bench& b) {
       const std::filesystem::path file = b.folder.path() / "points.csv";
       WriteText(file, "point,camera,x_px,y_px\norigin,cam1,3,4\nx,cam77,3,4\n");
       return testing::SetupErrorOf([&] { ReadFloorPoints(file.string(), Rig()); });
     },
     {"points.csv:3: there is no camera \"cam77\"; expected one of cam1"}},
    {"ABoardOfAnotherSizeThanTyped",
     [](Bench& b) {
       StudioFit fit;
       fit.bundle.cameras = Rig();
       fit.bundle.X_WB = {RigidTransform{}};
       fit.has_floor = true;
       const double true_mm = DistanceMm({"cam1", "cam4", 1}, fit.bundle.cameras);
       b.arguments.distance = "cam1:cam4:" + std::to_string(true_mm * 0.9);
       return FirstOf(CheckAll(b.arguments, fit));
     },
     {"cam1 and cam4", "by the tape", "0.90 times"}},
    {"ATapeWithoutALength",
     [](Bench& b) {
       StudioFit fit;
       fit.bundle.cameras = Rig();
       b.arguments.distance = "cam1:cam4";
       return testing::SetupErrorOf([&] { CheckAll(b.arguments, fit); });
     },
     {"cam1:cam4", "CAMERA:CAMERA:MM"}},
    {"LengthsInMetres",
     [](Bench&) {
       std::vector<CameraCalibration> cameras = Rig();
       for (CameraCalibration& camera : cameras) camera.X_CW.p /= 1000;
       return FirstOf(CheckCameras(cameras, true));
     },
     {"all cameras stand within 8 mm", "expected lengths in millimetres, not in metres"}},
    {"AMirroredCalibration",
     [](Bench&) {
       std::vector<CameraCalibration> cameras = Rig();
       cameras[2].X_CW.R.col(0) *= -1;
       return FirstOf(CheckCameras(cameras, true));
     },
     {"cam3: its rotation is a reflection", "mirrored"}},
    {"AFloorThatIsUpsideDown",
     [](Bench&) {
       std::vector<CameraCalibration> cameras = Rig();
       const RigidTransform over{ExpRotation({std::numbers::pi, 0, 0}), Vector3::Zero()};
       for (CameraCalibration& camera : cameras) camera.X_CW = camera.X_CW * over.Inverse();
       std::string all;
       for (const Finding& finding : CheckCameras(cameras, true)) all += finding.text + "; ";
       return all;
     },
     {"all cameras hang below the floor, cam1 by", "z points down", "mocap calibrate floor"}},
};

constexpr auto kNameOf = [](const ::testing::TestParamInfo<WrongInput>& info) {
  return std::string(info.param.name);
};

INSTANTIATE_TEST_SUITE_P(Recordings, WrongInputTest, ::testing::ValuesIn(kWrongRecordings),
                         kNameOf);
INSTANTIATE_TEST_SUITE_P(Detections, WrongInputTest, ::testing::ValuesIn(kWrongDetections),
                         kNameOf);
INSTANTIATE_TEST_SUITE_P(Worlds, WrongInputTest, ::testing::ValuesIn(kWrongWorlds), kNameOf);

}  // namespace
}  // namespace mocap

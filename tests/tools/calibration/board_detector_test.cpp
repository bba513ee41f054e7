#include "tools/calibration/board_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/errors.h"
#include "tests/tools/calibration/board_picture.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::PaintBoard;

const Board kBoard{BoardKind::kChessboard, 8, 5, 100, "", 0, false};

CameraCalibration SomeCamera() {
  return {"cam1", 640, 480, TsaiLens{5.2, 0.003, 1, {318, 243}, {0.01, 0.01}}, {}, {}};
}

RigidTransform Held(double tilt_x, double tilt_y, double turn, double distance_mm) {
  const Matrix3 R =
      ExpRotation({tilt_x, 0, 0}) * ExpRotation({0, tilt_y, 0}) * ExpRotation({0, 0, turn});
  return {R, Vector3(0, 0, distance_mm) - R * Vector3(350, 200, 0)};
}

double MeanErrorPx(const CameraCalibration& camera, const RigidTransform& X_CB,
                   const BoardCorners& found) {
  double sum = 0;
  for (std::size_t i = 0; i < found.ids.size(); ++i) {
    const Vector3 p_C = X_CB * kBoard.Corner(found.ids[i]);
    sum += (*PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z()) - found.pixels[i]).norm();
  }
  return sum / static_cast<double>(found.ids.size());
}

TEST(BoardDetectorTest, FindsCornersToAFractionOfAPixelAndNamesThemRightWhateverTheTurn) {
  const CameraCalibration camera = SomeCamera();
  const BoardDetector detector(kBoard);
  for (const double turn : {0.0, 0.4, 1.5, 3.1, -2.2}) {
    const RigidTransform X_CB = Held(0.4, -0.3, turn, 1700);
    const auto found = detector.Detect(PaintBoard(camera, X_CB, kBoard).view(), Effort::kQuick);
    ASSERT_TRUE(found) << turn;
    EXPECT_LT(MeanErrorPx(camera, X_CB, *found), 0.1) << turn;
  }
}

TEST(BoardDetectorTest, FindsABoardThatLiesFlatAndFarAwayWithEffort) {
  const CameraCalibration camera = SomeCamera();
  const RigidTransform X_CB = Held(-1.15, 0.02, 0.5, 3200);
  const auto found =
      BoardDetector(kBoard).Detect(PaintBoard(camera, X_CB, kBoard).view(), Effort::kThorough);
  ASSERT_TRUE(found);
  EXPECT_LT(MeanErrorPx(camera, X_CB, *found), 0.25);
}

TEST(BoardDetectorTest, SeesNothingWhereThereIsNoBoardOrAnotherOne) {
  const CameraCalibration camera = SomeCamera();
  const BoardDetector detector(kBoard);
  const Image<Bgr> empty(640, 480, Bgr{120, 120, 120});
  EXPECT_FALSE(detector.Detect(empty.view(), Effort::kThorough));
  Board other = kBoard;
  other.columns = 7;
  other.rows = 4;
  EXPECT_FALSE(
      detector.Detect(PaintBoard(camera, Held(0.2, 0.1, 0, 1700), other).view(), Effort::kQuick));
}

std::string ReasonOf(const std::string& text) {
  try {
    const BoardDetector detector(ParseBoard(text));
  } catch (const SetupError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BoardTest, SaysWhatIsWrongWithADescription) {
  EXPECT_EQ(ReasonOf("chess:8x5:100"), "accepted");
  EXPECT_EQ(ReasonOf("charuco:4x5:54:DICT_4X4_1000:0.75:inverted"), "accepted");
  EXPECT_THAT(ReasonOf("chess:8x5"), HasSubstr("too few parts"));
  EXPECT_THAT(ReasonOf("dots:8x5:100"), HasSubstr("not a kind of board"));
  EXPECT_THAT(ReasonOf("chess:8:100"), HasSubstr("not a size"));
  EXPECT_THAT(ReasonOf("chess:2x5:100"), HasSubstr("3 to 50"));
  for (const char* columns : {"1e300", "-1e300", "nan", "inf", "8.5"}) {
    EXPECT_THAT(ReasonOf("charuco:" + std::string(columns) + "x4:54"), HasSubstr("3 to 50"))
        << columns;
  }
  EXPECT_THAT(ReasonOf("chess:8x5:0.1"), HasSubstr("1 to 2000 mm"));
  EXPECT_THAT(ReasonOf("chess:8x5:100:DICT_4X4_50"), HasSubstr("a chessboard has no"));
  EXPECT_THAT(ReasonOf("charuco:8x5:100:DICT_9X9_50"),
              AllOf(HasSubstr("no dictionary"), HasSubstr("DICT_APRILTAG_36h11"),
                    HasSubstr("DICT_7X7_1000")));
  EXPECT_EQ(ReasonOf("charuco:8x5:100:DICT_APRILTAG_36h11"), "accepted");
  EXPECT_EQ(ReasonOf("charuco:8x5:100:Dict_AprilTag_16H5"), "accepted");
  EXPECT_THAT(ReasonOf("charuco:8x5:100:tag36h11"),
              AllOf(HasSubstr("no dictionary \"tag36h11\""), HasSubstr("DICT_APRILTAG_36h11")));
  EXPECT_EQ(ReasonOf("aprilgrid:6x6:88:0.3"), "accepted");
  EXPECT_THAT(ReasonOf("aprilgrid:6x6:88"), HasSubstr("has four parts"));
  EXPECT_THAT(ReasonOf("aprilgrid:6x6:88:30"), HasSubstr("not a gap of 0.05 to 1"));
  EXPECT_THAT(ReasonOf("aprilgrid:30x6:88:0.3"), HasSubstr("2 to 24 each way"));
  EXPECT_THAT(ReasonOf("charuco:20x20:30:DICT_4X4_50"), HasSubstr("the board has 200"));
}

}  // namespace
}  // namespace mocap

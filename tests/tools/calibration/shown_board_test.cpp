// Another board in the picture than --board says: it is named, and nothing is blamed on the person.
#include "tools/calibration/shown_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/calibration/marker_board_picture.h"
#include "tools/calibration/board_detector.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

struct OtherBoard {
  const char* name;
  const char* asked;
  const char* printed;
  bool older_layout;
  std::string says;
};

Image<Bgr> PictureOf(const Board& printed) {
  const CameraCalibration camera{
      "cam1", 640, 480, TsaiLens{6.2, 0.002, 1, {322, 238}, {0.01, 0.01}}, {}, {}};
  const Matrix3 R = ExpRotation({0.25, -0.2, 0.15});
  const Vector3 first = printed.Corner(0), last = printed.Corner(printed.corners() - 1);
  const double size_mm = (last - first).norm();
  const RigidTransform X_CB{R, Vector3(0, 0, 1.9 * size_mm) - R * (first + last) / 2};
  return printed.HasMarkers() ? testing::PaintMarkerBoard(camera, X_CB, printed)
                              : testing::PaintBoard(camera, X_CB, printed);
}

/// What a calibration would say of a camera that sees this.
std::string ReasonFor(const BoardDetector& detector, const Image<Bgr>& picture) {
  const auto why = detector.Detect(picture.view(), Effort::kQuick)
                       ? detector.WhyNotAfterAll(picture.view())
                       : detector.WhyNot(picture.view());
  return why ? why->text : "nothing";
}

class OtherBoardTest : public ::testing::TestWithParam<OtherBoard> {};

TEST_P(OtherBoardTest, IsNamedAsBoardWouldSayIt) {
  Board printed = ParseBoard(GetParam().printed);
  printed.older_layout = GetParam().older_layout;
  EXPECT_THAT(ReasonFor(BoardDetector(ParseBoard(GetParam().asked)), PictureOf(printed)),
              HasSubstr(GetParam().says));
}

const OtherBoard kOtherBoards[] = {
    {"ColumnsAndRowsExchanged", "charuco:7x6:60", "charuco:6x7:60", false,
     "looks like charuco:6x7:60:DICT_4X4_50:0.75, not charuco:7x6:60:DICT_4X4_50:0.75"},
    {"ColumnsAndRowsExchangedInTheOlderLayout", "charuco:8x5:60", "charuco:5x8:60", true,
     "looks like charuco:5x8:60"},
    {"FewerColumns", "charuco:7x6:60", "charuco:5x4:60", false, "looks like charuco:5x4:60"},
    {"MoreRows", "charuco:7x5:60", "charuco:7x7:60", false, "looks like charuco:7x7:60"},
    {"OneRowMoreInTheOlderLayout", "charuco:7x5:60", "charuco:7x6:60", true,
     "looks like charuco:7x6:60"},
    {"AnotherDictionary", "charuco:7x6:60:DICT_6X6_250", "charuco:7x6:60:DICT_5X5_100", false,
     "looks like charuco:7x6:60:DICT_5X5_50:0.75, not charuco:7x6:60:DICT_6X6_250:0.75"},
    {"AprilTagsForOthers", "charuco:7x6:60", "charuco:7x6:60:DICT_APRILTAG_36h11", false,
     "looks like charuco:7x6:60:DICT_APRILTAG_36h11"},
    {"SmallerMarkers", "charuco:7x6:60", "charuco:7x6:60:0.5", false, "DICT_4X4_50:0.5"},
    {"WhiteOnBlackAndOfOtherCounts", "charuco:7x6:60", "charuco:5x4:60:inverted", false,
     "looks like charuco:5x4:60:DICT_4X4_50:0.75:inverted"},
    {"CharucoForAChessboard", "chess:8x5:60", "charuco:7x6:60:DICT_5X5_50", false,
     "looks like charuco:7x6:MM:DICT_5X5_50:0.75, not chess:8x5:60; MM is the side of a square"},
    {"CharucoForAChessboardOfItsCorners", "chess:6x5:60", "charuco:7x6:60", false,
     "looks like charuco:7x6:MM:DICT_4X4_50:0.75"},
    {"CharucoForAChessboardOfItsSquares", "chess:7x6:60", "charuco:7x6:60", false,
     "looks like charuco:7x6:MM:DICT_4X4_50:0.75"},
    {"OlderLayoutOfEvenRowsForOddRows", "charuco:7x7:60", "charuco:7x6:60", true,
     "looks like charuco:7x6:60:DICT_4X4_50:0.75, not charuco:7x7:60"},
    {"WhiteOnBlackForAChessboardOfItsCorners", "chess:4x3:60", "charuco:5x4:60:inverted", false,
     "looks like charuco:5x4:MM:DICT_4X4_50:0.75:inverted"},
    {"ChessboardForCharuco", "charuco:7x6:60", "chess:8x5:60", false,
     "looks like chess:8x5:MM, not charuco:7x6:60"},
    {"ChessboardWithMoreCorners", "chess:7x4:60", "chess:8x5:60", false,
     "looks like chess:8x5:60, not chess:7x4:60; --board counts inner corners"},
    {"ChessboardWithFewerCorners", "chess:9x6:60", "chess:7x4:60", false,
     "looks like chess:7x4:60, not chess:9x6:60"},
    {"GridOfTagsForCharuco", "charuco:7x6:60", "aprilgrid:6x4:55:0.3", false,
     "looks like aprilgrid:6x4:MM:0.3, not charuco:7x6:60:DICT_4X4_50:0.75; MM is the side of a "
     "tag"},
    {"GridOfTagsForAChessboard", "chess:8x5:60", "aprilgrid:6x4:55:0.3", false,
     "looks like aprilgrid:6x4:MM:0.3"},
    {"CharucoForAGridOfTags", "aprilgrid:6x6:55:0.3", "charuco:7x6:60:DICT_APRILTAG_36h11", false,
     "looks like charuco:7x6:MM:DICT_APRILTAG_36h11:0.75, not aprilgrid:6x6:55:0.3"},
    {"GridOfTagsExchanged", "aprilgrid:4x6:55:0.3", "aprilgrid:6x4:55:0.3", false,
     "looks like aprilgrid:6x4:55:0.3, not aprilgrid:4x6:55:0.3"},
    {"GridOfTagsWithOtherGaps", "aprilgrid:6x4:55:0.3", "aprilgrid:6x4:55:0.2", false,
     "looks like aprilgrid:6x4:55:0.2, not aprilgrid:6x4:55:0.3"}};

constexpr auto kNameOfOther = [](const ::testing::TestParamInfo<OtherBoard>& info) {
  return std::string(info.param.name);
};

INSTANTIATE_TEST_SUITE_P(Boards, OtherBoardTest, ::testing::ValuesIn(kOtherBoards), kNameOfOther);

TEST(ShownBoardTest, TheExpectedBoardIsNotTakenForAnother) {
  for (const char* spec :
       {"chess:8x5:60", "chess:5x8:60", "chess:7x6:60", "charuco:7x6:60", "aprilgrid:6x4:55:0.3"}) {
    const Board board = ParseBoard(spec);
    const Image<Bgr> picture = PictureOf(board);
    const BoardDetector detector(board);
    EXPECT_TRUE(detector.Detect(picture.view(), Effort::kQuick)) << spec;
    EXPECT_EQ(ReasonFor(detector, picture), "nothing") << spec;
  }
}

// Before a dark wall, the rim looks like bright squares and the wall like dark ones.
TEST(ShownBoardTest, TheEdgeOfTheSquaresIsNoRowOfCorners) {
  constexpr int kSide_px = 40, kRim_px = 24;
  for (const int wall : {20, 90, 160}) {
    cv::Mat gray(400, 560, CV_8U, cv::Scalar(wall));
    const cv::Rect squares(90, 70, 9 * kSide_px, 6 * kSide_px);
    gray(cv::Rect(squares.x - kRim_px, squares.y - kRim_px, squares.width + 2 * kRim_px,
                  squares.height + 2 * kRim_px))
        .setTo(225);
    for (int i = 0; i < 54; ++i) {
      const int x = i % 9, y = i / 9;
      if ((x + y) % 2 == 0)
        gray(cv::Rect(squares.x + x * kSide_px, squares.y + y * kSide_px, kSide_px, kSide_px))
            .setTo(30);
    }
    const auto shown = FindShownChessboard(gray, ParseBoard("chess:8x5:60"));
    ASSERT_TRUE(shown) << wall;
    EXPECT_EQ(shown->Spec(), "chess:8x5:60") << wall;
  }
}

TEST(ShownBoardTest, ALargerDictionaryOfTheSameMarkersIsTheSame) {
  const BoardDetector detector(ParseBoard("charuco:7x6:60:DICT_4X4_250"));
  const Image<Bgr> picture = PictureOf(ParseBoard("charuco:7x6:60:DICT_4X4_50"));
  EXPECT_TRUE(detector.Detect(picture.view(), Effort::kQuick));
}

TEST(ShownBoardTest, WhatIsSaidCanBeGivenAsBoard) {
  for (const char* spec : {"charuco:7x6:60:DICT_APRILTAG_36h11:0.75:inverted", "chess:8x5:115.5",
                           "aprilgrid:6x6:88:0.3", "wand:500"}) {
    EXPECT_EQ(ParseBoard(spec).Spec(), spec);
  }
}

}  // namespace
}  // namespace mocap

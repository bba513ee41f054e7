#include "tools/calibration/board_print.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <regex>

#include "drivers/take/text_file.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/calibration/board_detector.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

constexpr double kPrinted_px_per_mm = 3;

/// The print as a scanner sees it, on a grey table.
Image<Bgr> ScanOf(const BoardPrint& print) {
  constexpr int kTable_px = 30;
  const auto px = [](double mm) { return static_cast<int>(std::lround(mm * kPrinted_px_per_mm)); };
  Image<Bgr> scan(px(print.size_mm.x()) + 2 * kTable_px, px(print.size_mm.y()) + 2 * kTable_px,
                  Bgr{120, 120, 120});
  for (const PrintedPatch& patch : print.patches) {
    const Vector2 end_mm = patch.at_mm + patch.size_mm;
    const std::uint8_t value = patch.is_black ? 30 : 225;
    for (int y = px(patch.at_mm.y()); y < px(end_mm.y()); ++y) {
      for (int x = px(patch.at_mm.x()); x < px(end_mm.x()); ++x)
        scan(x + kTable_px, y + kTable_px) = {value, value, value};
    }
  }
  return scan;
}

class PrintedBoard : public ::testing::TestWithParam<const char*> {};

TEST_P(PrintedBoard, IsFoundWithAllCornersInTheirPlaces) {
  const Board board = ParseBoard(GetParam());
  const BoardPrint print = PrintOf(board);
  const auto found = BoardDetector(board).Detect(ScanOf(print).view(), Effort::kQuick);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->ids.size(), static_cast<std::size_t>(board.corners()));
  EXPECT_FALSE(found->older_layout);
  for (std::size_t i = 0; i < found->ids.size(); ++i) {
    // Corners are between pixels.
    const Vector2 at_mm = print.first_corner_mm + board.Corner(found->ids[i]).head<2>();
    const Vector2 at_px = kPrinted_px_per_mm * at_mm + Vector2::Constant(30 - 0.5);
    EXPECT_LT((found->pixels[i] - at_px).norm(), 0.5) << found->ids[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Boards, PrintedBoard,
                         ::testing::Values("chess:8x5:30", "charuco:7x6:30",
                                           "charuco:5x8:30:DICT_5X5_100:0.6",
                                           "charuco:7x5:30:DICT_4X4_50:0.75:inverted",
                                           "aprilgrid:4x3:40:0.3"));

std::string PdfOf(const std::string& board, const Vector2& page_mm) {
  testing::TemporaryFolder folder;
  WriteBoardPdf(folder.path() / "board.pdf", ParseBoard(board), page_mm);
  return testing::ReadText(folder.path() / "board.pdf");
}

Vector2 PageMmOf(const std::string& pdf) {
  std::smatch box;
  if (!std::regex_search(pdf, box, std::regex(R"(MediaBox \[ 0 0 ([0-9.]+) ([0-9.]+) \])")))
    return Vector2::Zero();
  return Vector2(std::stod(box[1]), std::stod(box[2])) * 25.4 / 72;
}

TEST(BoardPdf, HasThePageThatTheBoardNeeds) {
  // Nine by six squares, half a square around them, and the ruler below.
  EXPECT_LT((PageMmOf(PdfOf("chess:8x5:100", Vector2::Zero())) - Vector2(1000, 718)).norm(), 0.1);
}

TEST(BoardPdf, HasTheWantedPageTurnedAsTheBoard) {
  EXPECT_LT((PageMmOf(PdfOf("chess:8x5:20", ParsePage("a4"))) - Vector2(297, 210)).norm(), 0.1);
  EXPECT_LT((PageMmOf(PdfOf("chess:5x8:20", ParsePage("a4"))) - Vector2(210, 297)).norm(), 0.1);
}

TEST(BoardPdf, APageThatIsTooSmallIsRefused) {
  EXPECT_THAT(testing::SetupErrorOf([] { PdfOf("chess:8x5:100", ParsePage("a3")); }),
              HasSubstr("--page is 420 x 297 mm, but the board with its rim and ruler needs 1000 "
                        "x 718 mm"));
  EXPECT_THAT(testing::SetupErrorOf([] { PdfOf("wand:500", Vector2::Zero()); }),
              HasSubstr("a wand is not printed"));
}

TEST(BoardPdf, ReplacesNothingButPdfs) {
  testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "board.pdf";
  const Board board = ParseBoard("chess:8x5:20");
  EXPECT_THAT(testing::SetupErrorOf(
                  [&] { WriteBoardPdf(folder.path() / "board.png", board, Vector2::Zero()); }),
              HasSubstr("board.png: does not end in .pdf"));
  testing::WriteText(file, "[cameras]\n");
  EXPECT_THAT(testing::SetupErrorOf([&] { WriteBoardPdf(file, board, Vector2::Zero()); }),
              HasSubstr("board.pdf: exists"));
  EXPECT_EQ(testing::ReadText(file), "[cameras]\n");
  testing::WriteText(file, "%PDF-1.5\n");
  WriteBoardPdf(file, board, Vector2::Zero());
  EXPECT_GT(std::filesystem::file_size(file), 500u);
}

TEST(BoardPdf, PagesAreOfIsoOrInMillimetres) {
  EXPECT_EQ(ParsePage("A3"), Vector2(297, 420));
  EXPECT_EQ(ParsePage("a5"), Vector2(148, 210));
  EXPECT_EQ(ParsePage("1200x900.5"), Vector2(1200, 900.5));
  for (const char* wrong :
       {"", "a6", "letter", "100", "100x", "0x10", "100x200mm", "1e9x10", "nanx5"})
    EXPECT_THAT(testing::SetupErrorOf([&] { ParsePage(wrong); }), HasSubstr("expected a0 to a5"))
        << wrong;
}

}  // namespace
}  // namespace mocap

#include "tools/calibration/board_print.h"

#include <cairo-pdf.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <utility>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take/text_file.h"
#include "tools/calibration/marker_dictionaries.h"

namespace mocap {
namespace {

constexpr double kPointsPerMm = 72 / 25.4;
// ISO 216: the sides of A0, each halved and rounded down for the next.
constexpr int kA0Short_mm = 841, kA0Long_mm = 1189, kSmallestPage = 5;
constexpr double kLongestPage_mm = 5000;  // A PDF page has at most 14400 points.
// Detectors need light around a board: OpenCV says "the wider the better".
constexpr double kRimShare = 0.5;
constexpr double kFooter_mm = 18, kTick_mm = 10, kLongestRuler_mm = 200, kShortestRuler_mm = 50;
constexpr double kTextSize_mm = 3.2, kLine_mm = 0.2;

class Sheet {
 public:
  explicit Sheet(const Board& board) : board_(board), rim_mm_(kRimShare * board.square_mm) {}

  void PutSquares() {
    Begin(board_.square_mm * Vector2(board_.columns + 1, board_.rows + 1));
    print_.first_corner_mm = Vector2::Constant(rim_mm_ + board_.square_mm);
    for (const auto& [x, y] : Cells(board_.columns + 1, board_.rows + 1)) {
      if ((x + y) % 2 == 0) Put(Place(x, y), Vector2::Constant(board_.square_mm), Ink::kBlack);
    }
  }

  void PutMarkersIntoSquares() {
    const double marker_mm = board_.square_mm * board_.marker_share;
    const Vector2 gap_mm = Vector2::Constant((board_.square_mm - marker_mm) / 2);
    int id = 0;
    for (const auto& [x, y] : Cells(board_.columns + 1, board_.rows + 1)) {
      if ((x + y) % 2 == 1) PutMarker(Place(x, y) + gap_mm, marker_mm, BitsOf(id++, 1));
    }
  }

  // As Kalibr prints them: tags have borders of two bits and are numbered from the lower left;
  // OpenCV has the same codes, turned by half a turn. Black squares touch their corners.
  void PutTags() {
    const int columns = board_.columns / 2, rows = board_.rows / 2;
    const double tag_mm = board_.square_mm * board_.marker_share;
    const Vector2 gap_mm = Vector2::Constant(board_.square_mm - tag_mm);
    Begin(board_.square_mm * Vector2(columns, rows) + gap_mm);
    print_.first_corner_mm = Place(0, rows) + Vector2(gap_mm.x(), 0);
    for (const auto& [x, y] : Cells(columns + 1, rows + 1)) Put(Place(x, y), gap_mm, Ink::kBlack);
    for (const auto& [x, y] : Cells(columns, rows)) {
      cv::Mat bits = BitsOf((rows - 1 - y) * columns + x, 2);
      cv::rotate(bits, bits, cv::ROTATE_180);
      PutMarker(Place(x, y) + gap_mm, tag_mm, bits);
    }
  }

  BoardPrint Take() { return std::move(print_); }

 private:
  enum class Ink { kBlack, kWhite };

  void Begin(const Vector2& board_mm) {
    print_.size_mm = board_mm + Vector2::Constant(2 * rim_mm_);
    Put(Vector2::Zero(), print_.size_mm, Ink::kWhite);
  }

  static std::vector<std::pair<int, int>> Cells(int columns, int rows) {
    std::vector<std::pair<int, int>> cells;
    for (int i = 0; i < columns * rows; ++i) cells.emplace_back(i % columns, i / columns);
    return cells;
  }

  Vector2 Place(int x, int y) const {
    return Vector2::Constant(rim_mm_) + board_.square_mm * Vector2(x, y);
  }

  void Put(const Vector2& at_mm, const Vector2& size_mm, Ink ink) {
    print_.patches.push_back({at_mm, size_mm, (ink == Ink::kBlack) != board_.inverted});
  }

  cv::Mat BitsOf(int id, int border_bits) const {
    const auto markers = DictionaryOf(board_.dictionary);
    cv::Mat bits;
    markers->drawMarker(id, markers->markerSize + 2 * border_bits, bits, border_bits);
    return bits;
  }

  void PutMarker(const Vector2& at_mm, double side_mm, const cv::Mat& bits) {
    const double bit_mm = side_mm / bits.cols;
    Put(at_mm, Vector2::Constant(side_mm), Ink::kBlack);
    for (const auto& [x, y] : Cells(bits.cols, bits.rows)) {
      if (bits.at<std::uint8_t>(y, x) != 0)
        Put(at_mm + bit_mm * Vector2(x, y), Vector2::Constant(bit_mm), Ink::kWhite);
    }
  }

  const Board& board_;
  const double rim_mm_;
  BoardPrint print_;
};

double RulerMm(double width_mm) {
  const double fitting_mm = std::floor(width_mm / kShortestRuler_mm) * kShortestRuler_mm;
  return std::clamp(fitting_mm, kShortestRuler_mm, kLongestRuler_mm);
}

void DrawText(cairo_t* to, const Vector2& at_mm, const std::string& text) {
  cairo_move_to(to, at_mm.x(), at_mm.y());
  cairo_show_text(to, text.c_str());
}

// A ruler, and how the board is called.
void DrawFooter(cairo_t* to, const Vector2& at_mm, double width_mm, const Board& board) {
  const double ruler_mm = RulerMm(width_mm);
  cairo_set_source_rgb(to, 0, 0, 0);
  cairo_set_line_width(to, kLine_mm);
  for (double x = 0; x <= ruler_mm; x += kTick_mm) {
    cairo_move_to(to, at_mm.x() + x, at_mm.y());
    cairo_rel_line_to(to, 0, x == 0 || x == ruler_mm ? 4 : 2);
  }
  cairo_move_to(to, at_mm.x(), at_mm.y());
  cairo_rel_line_to(to, ruler_mm, 0);
  cairo_stroke(to);
  cairo_select_font_face(to, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(to, kTextSize_mm);
  DrawText(to, at_mm + Vector2(0, 9),
           fmt::format("{:.0f} mm: print at 100 %, and measure", ruler_mm));
  DrawText(to, at_mm + Vector2(0, 14), "--board " + board.Spec());
}

void Draw(cairo_t* to, const BoardPrint& print, const Vector2& at_mm) {
  for (const PrintedPatch& patch : print.patches) {
    const double white = patch.is_black ? 0 : 1;
    cairo_set_source_rgb(to, white, white, white);
    cairo_rectangle(to, at_mm.x() + patch.at_mm.x(), at_mm.y() + patch.at_mm.y(), patch.size_mm.x(),
                    patch.size_mm.y());
    cairo_fill(to);
  }
}

cairo_status_t AppendPdf(void* pdf, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(pdf)->append(data, data + length);
  return CAIRO_STATUS_SUCCESS;
}

// The page, turned as the board lies.
Vector2 PageFor(const Vector2& needed_mm, const Vector2& page_mm) {
  if (page_mm.isZero()) return needed_mm;
  const bool is_wide = needed_mm.x() > needed_mm.y();
  const Vector2 page(is_wide ? page_mm.maxCoeff() : page_mm.minCoeff(),
                     is_wide ? page_mm.minCoeff() : page_mm.maxCoeff());
  if ((page - needed_mm).minCoeff() < 0)
    throw SetupError(
        fmt::format("--page is {:.0f} x {:.0f} mm, but the board with its rim and ruler needs "
                    "{:.0f} x {:.0f} mm; expected a larger page, a smaller board, or no --page",
                    page.x(), page.y(), needed_mm.x(), needed_mm.y()));
  return page;
}

}  // namespace

BoardPrint PrintOf(const Board& board) {
  if (board.kind == BoardKind::kWand)
    throw SetupError("--board " + board.Spec() + ": a wand is not printed; expected a board");
  Sheet sheet(board);
  if (board.kind == BoardKind::kAprilGrid) {
    sheet.PutTags();
  } else {
    sheet.PutSquares();
    if (board.kind == BoardKind::kCharuco) sheet.PutMarkersIntoSquares();
  }
  return sheet.Take();
}

Vector2 ParsePage(const std::string& text) {
  const bool is_iso = text.size() == 2 && (text[0] == 'a' || text[0] == 'A') && text[1] >= '0' &&
                      text[1] <= '0' + kSmallestPage;
  if (is_iso) {
    int short_mm = kA0Short_mm, long_mm = kA0Long_mm;
    for (char size = '0'; size < text[1]; ++size) long_mm = std::exchange(short_mm, long_mm / 2);
    return Vector2(short_mm, long_mm);
  }
  Vector2 page_mm = Vector2::Zero();
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, page_mm.x());
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, page_mm.y());
    const bool is_page = page_mm.minCoeff() > 0 && page_mm.maxCoeff() <= kLongestPage_mm;
    if (height.ec == std::errc() && height.ptr == end && is_page) return page_mm;
  }
  throw SetupError(fmt::format("--page {}: expected a0 to a{}, or WIDTHxHEIGHT in mm up to {:.0f}",
                               Quoted(text), kSmallestPage, kLongestPage_mm));
}

void WriteBoardPdf(const std::filesystem::path& file, const Board& board, const Vector2& page_mm) {
  const BoardPrint print = PrintOf(board);
  const Vector2 needed_mm =
      Vector2(std::max(print.size_mm.x(), kShortestRuler_mm + kFooter_mm), print.size_mm.y()) +
      Vector2(0, kFooter_mm);
  if (needed_mm.maxCoeff() > kLongestPage_mm)
    throw SetupError(fmt::format("--board {}: needs {:.0f} x {:.0f} mm; expected at most {:.0f} mm",
                                 board.Spec(), needed_mm.x(), needed_mm.y(), kLongestPage_mm));
  const Vector2 page = PageFor(needed_mm, page_mm);
  constexpr std::array<std::string_view, 1> kPdf = {"%PDF-"};
  RequireSuffix(file, ".pdf");
  RequireWritable(file);
  RequireOwn(file, kPdf, "a PDF");
  std::string pdf;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_pdf_surface_create_for_stream(&AppendPdf, &pdf, page.x() * kPointsPerMm,
                                          page.y() * kPointsPerMm),
      &cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> to(cairo_create(surface.get()),
                                                              &cairo_destroy);
  cairo_scale(to.get(), kPointsPerMm, kPointsPerMm);
  const Vector2 at_mm = (page - needed_mm) / 2;
  Draw(to.get(), print, at_mm);
  const double margin_mm = kFooter_mm / 2;
  DrawFooter(to.get(), at_mm + Vector2(margin_mm, print.size_mm.y()), needed_mm.x() - 2 * margin_mm,
             board);
  cairo_surface_finish(surface.get());
  if (const cairo_status_t status = cairo_surface_status(surface.get());
      status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(file.string() + ": " + cairo_status_to_string(status));
  ReplaceText(file, pdf);
}

}  // namespace mocap

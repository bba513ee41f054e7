#include "tools/calibration/shown_board.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <utility>
#include <vector>

#include "tools/calibration/marker_board.h"
#include "tools/calibration/marker_dictionaries.h"

namespace mocap {
namespace {

constexpr int kFewestChessCorners = 12;
constexpr double kShareStep = 0.05;  // Corners of single markers are not better.
constexpr float kWithinRim = 0.3;    // Squares; rims are wider.
constexpr double kPlainSquares = 0.9, kLeastContrastOfSquares = 20;

struct ShownMarkers {
  GridMatch match;
  MarkerGrid grid;
  MarkerStyle style = MarkerStyle::kCharuco;
  std::string dictionary;
};

std::optional<ShownMarkers> FindShownMarkers(const cv::Mat& gray) {
  std::optional<ShownMarkers> best;
  const auto search = [&](const std::string& dictionary, MarkerStyle style) {
    const std::vector<Marker> markers = FindMarkers(gray, dictionary, style);
    const auto grid = FindGrid(markers);
    const bool tags = grid && grid->layout == MarkerGrid::Layout::kTags;
    if (!grid || tags != (style == MarkerStyle::kAprilGrid)) return;
    auto match = MatchGrid(*grid, markers);
    if (match && (!best || match->pairs > best->match.pairs))
      best = ShownMarkers{std::move(*match), *grid, style, dictionary};
  };
  for (const std::string& dictionary : LargestDictionaries())
    search(dictionary, MarkerStyle::kCharuco);
  search(kAprilGridDictionary, MarkerStyle::kAprilGrid);
  return best;
}

Board BoardOf(const cv::Mat& gray, const ShownMarkers& shown, const Board& expected) {
  Board board;
  board.inverted = expected.inverted;
  const int last_id = shown.match.last_id;
  board.dictionary = ShareMarker(shown.dictionary, expected.dictionary, last_id)
                         ? expected.dictionary
                         : SmallestDictionary(shown.dictionary, last_id);
  board.marker_share = MeasureMarkerShare(gray, shown.grid, shown.match.markers, shown.style);
  if (shown.style == MarkerStyle::kCharuco)
    board.marker_share = std::round(board.marker_share / kShareStep) * kShareStep;
  if (shown.style == MarkerStyle::kAprilGrid) {
    board.kind = BoardKind::kAprilGrid;
    board.columns = 2 * shown.grid.columns;
    board.rows = 2 * (last_id / shown.grid.columns + 1);
  } else {
    board.kind = BoardKind::kCharuco;
    board.columns = shown.grid.columns - 1;
    board.rows = static_cast<int>(shown.grid.PlaceOf(last_id).y());
    board.older_layout = shown.grid.layout == MarkerGrid::Layout::kWhiteFirst;
    // That layout differs only if there is an even number of rows of squares.
    if (board.older_layout && board.rows % 2 == 0) ++board.rows;
  }
  if (board.kind != expected.kind) return board;
  if (IsMarkerShare(board.marker_share, expected)) board.marker_share = expected.marker_share;
  // Tags are given by their own side, squares by theirs.
  board.square_mm = expected.square_mm;
  if (board.kind == BoardKind::kAprilGrid)
    board.square_mm *= expected.marker_share / board.marker_share;
  return board;
}

// Darkest and brightest of some points within a square whose upper left corner is given.
std::pair<double, double> RangeOf(const cv::Mat& gray, const cv::Point2f* upper,
                                  const cv::Point2f* lower) {
  double low = 255, high = 0;
  for (const float along : {0.3f, 0.5f, 0.7f}) {
    for (const float down : {0.3f, 0.5f, 0.7f}) {
      const cv::Point2f p = (upper[0] * (1 - along) + upper[1] * along) * (1 - down) +
                            (lower[0] * (1 - along) + lower[1] * along) * down;
      const int x = std::clamp(static_cast<int>(std::lround(p.x)), 0, gray.cols - 1);
      const int y = std::clamp(static_cast<int>(std::lround(p.y)), 0, gray.rows - 1);
      const auto value = static_cast<double>(gray.at<std::uint8_t>(y, x));
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return {low, high};
}

/// Corners of a chessboard in a picture, row by row.
struct ChessCorners {
  std::vector<cv::Point2f> points;
  cv::Size size;

  const cv::Point2f& At(int x, int y) const {
    return points[static_cast<std::size_t>(y * size.width + x)];
  }
  // The place of a point of the board, in squares from the first corner; also around the corners.
  cv::Point2f PlaceOf(const cv::Point2f& in_squares) const {
    const int x = std::clamp(static_cast<int>(in_squares.x), 0, size.width - 2);
    const int y = std::clamp(static_cast<int>(in_squares.y), 0, size.height - 2);
    const cv::Point2f &a = At(x, y), &b = At(x + 1, y), &c = At(x, y + 1), &d = At(x + 1, y + 1);
    const float right = in_squares.x - static_cast<float>(x);
    const float down = in_squares.y - static_cast<float>(y);
    return (a * (1 - right) + b * right) * (1 - down) + (c * (1 - right) + d * right) * down;
  }
};

/// How the squares between corners alternate.
struct Alternation {
  double between = 0;  ///< Brightness between that of dark and of bright squares.
  int dark = 0;        ///< Squares are dark where (x + y) % 2 is this.
};

// Empty unless squares are dark and bright in turn, and without markers.
std::optional<Alternation> AlternationOf(const cv::Mat& gray, const ChessCorners& corners) {
  std::vector<std::pair<double, double>> ranges[2];
  double lowest = 255, highest = 0;
  for (int y = 0; y + 1 < corners.size.height; ++y) {
    for (int x = 0; x + 1 < corners.size.width; ++x) {
      const auto range = RangeOf(gray, &corners.At(x, y), &corners.At(x, y + 1));
      ranges[(x + y) % 2].push_back(range);
      lowest = std::min(lowest, range.first);
      highest = std::max(highest, range.second);
    }
  }
  if (highest - lowest < kLeastContrastOfSquares) return std::nullopt;
  const double between = (lowest + highest) / 2;
  const auto count = [&](int dark) {
    const auto is_dark = [&](const auto& range) { return range.second < between; };
    const auto is_bright = [&](const auto& range) { return range.first > between; };
    return std::ranges::count_if(ranges[dark], is_dark) +
           std::ranges::count_if(ranges[1 - dark], is_bright);
  };
  const int dark = count(0) > count(1) ? 0 : 1;
  const auto all = static_cast<double>(ranges[0].size() + ranges[1].size());
  if (static_cast<double>(count(dark)) < kPlainSquares * all) return std::nullopt;
  return Alternation{between, dark};
}

// Whether squares go on beyond an outermost row or column of corners: corners on the edge of the
// printed squares, towards the rim, are no inner ones. What is outside of the picture is not known.
// @param at  middle of each square beyond, on the line of corners. @param out  away from the
// corners.
bool GoesOn(const cv::Mat& gray, const ChessCorners& corners, const Alternation& alternation,
            const std::vector<cv::Point2f>& at, const cv::Point2f& out) {
  int visible = 0, dark = 0;
  for (const cv::Point2f& middle : at) {
    const cv::Point2f square = middle + out / 2;
    const int parity = cvFloor(square.x) + cvFloor(square.y) + 2;
    if (parity % 2 != alternation.dark) continue;
    const cv::Point pixel = corners.PlaceOf(middle + out * kWithinRim);
    if (!cv::Rect(0, 0, gray.cols, gray.rows).contains(pixel)) continue;
    ++visible;
    dark += gray.at<std::uint8_t>(pixel) < alternation.between;
  }
  return visible == 0 || 2 * dark > visible;
}

// Number of inner corners across and down.
cv::Size InnerCorners(const cv::Mat& gray, const ChessCorners& corners,
                      const Alternation& alternation) {
  const auto last_x = static_cast<float>(corners.size.width - 1);
  const auto last_y = static_cast<float>(corners.size.height - 1);
  std::vector<cv::Point2f> left, right, above, below;
  for (float y = 0.5; y < last_y; ++y) {
    left.emplace_back(0, y);
    right.emplace_back(last_x, y);
  }
  for (float x = 0.5; x < last_x; ++x) {
    above.emplace_back(x, 0);
    below.emplace_back(x, last_y);
  }
  const auto ends = [&](const std::vector<cv::Point2f>& at, float right_of, float below_of) {
    return GoesOn(gray, corners, alternation, at, {right_of, below_of}) ? 0 : 1;
  };
  return {corners.size.width - ends(left, -1, 0) - ends(right, 1, 0),
          corners.size.height - ends(above, 0, -1) - ends(below, 0, 1)};
}

}  // namespace

std::optional<Board> FindShownMarkerBoard(const cv::Mat& gray, const Board& expected) {
  const auto markers = FindShownMarkers(gray);
  return markers ? std::optional(BoardOf(gray, *markers, expected)) : std::nullopt;
}

std::optional<Board> FindShownChessboard(const cv::Mat& gray, const Board& expected) {
  ChessCorners corners;
  cv::Mat meta;
  const int flags = cv::CALIB_CB_NORMALIZE_IMAGE;
  if (!cv::findChessboardCornersSB(gray, {3, 3}, corners.points, flags | cv::CALIB_CB_LARGER,
                                   meta) ||
      static_cast<int>(corners.points.size()) < kFewestChessCorners)
    return std::nullopt;
  corners.size = meta.size();
  // Growing from a few corners may end too early; a part of a board is not found by its size.
  if (!cv::findChessboardCornersSB(gray, corners.size, corners.points, flags)) return std::nullopt;
  const auto alternation = AlternationOf(gray, corners);
  if (!alternation) return std::nullopt;
  const cv::Size inner = InnerCorners(gray, corners, *alternation);
  Board board;
  board.columns = std::max(inner.width, inner.height);
  board.rows = std::min(inner.width, inner.height);
  if (expected.kind == BoardKind::kChessboard) {
    board.square_mm = expected.square_mm;
    if (expected.columns < expected.rows) std::swap(board.columns, board.rows);
  }
  return board;
}

bool MayBe(const Board& shown, const Board& expected) {
  if (shown.kind != expected.kind || shown.columns != expected.columns) return false;
  if (shown.kind == BoardKind::kChessboard) return shown.rows == expected.rows;
  const bool layout_exists = !shown.older_layout || expected.rows % 2 == 1;
  return shown.rows <= expected.rows && shown.dictionary == expected.dictionary &&
         shown.marker_share == expected.marker_share && layout_exists;
}

std::string LooksLikeText(const Board& shown, const Board& expected) {
  std::string text = "looks like " + shown.Spec() + ", not " + expected.Spec();
  if (shown.kind == BoardKind::kChessboard && expected.kind == BoardKind::kChessboard)
    text += "; --board counts inner corners, not squares";
  if (shown.square_mm == 0)
    text += std::string("; MM is the side of a ") +
            (shown.kind == BoardKind::kAprilGrid ? "tag" : "square") + " as measured";
  return text;
}

}  // namespace mocap

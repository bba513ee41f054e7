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

// Whether squares between found corners are dark and bright in turn, and without markers.
bool IsPlain(const cv::Mat& gray, const std::vector<cv::Point2f>& corners, const cv::Size& size) {
  std::vector<std::pair<double, double>> ranges[2];
  double lowest = 255, highest = 0;
  for (int y = 0; y + 1 < size.height; ++y) {
    for (int x = 0; x + 1 < size.width; ++x) {
      const cv::Point2f* upper = &corners[static_cast<std::size_t>(y * size.width + x)];
      const auto range = RangeOf(gray, upper, upper + size.width);
      ranges[(x + y) % 2].push_back(range);
      lowest = std::min(lowest, range.first);
      highest = std::max(highest, range.second);
    }
  }
  if (highest - lowest < kLeastContrastOfSquares) return false;
  const double between = (lowest + highest) / 2;
  const auto count = [&](int dark) {
    const auto is_dark = [&](const auto& range) { return range.second < between; };
    const auto is_bright = [&](const auto& range) { return range.first > between; };
    return std::ranges::count_if(ranges[dark], is_dark) +
           std::ranges::count_if(ranges[1 - dark], is_bright);
  };
  return static_cast<double>(std::max(count(0), count(1))) >=
         kPlainSquares * static_cast<double>(ranges[0].size() + ranges[1].size());
}

}  // namespace

std::optional<Board> FindShownMarkerBoard(const cv::Mat& gray, const Board& expected) {
  const auto markers = FindShownMarkers(gray);
  return markers ? std::optional(BoardOf(gray, *markers, expected)) : std::nullopt;
}

std::optional<Board> FindShownChessboard(const cv::Mat& gray, const Board& expected) {
  std::vector<cv::Point2f> corners;
  cv::Mat meta;
  const int flags = cv::CALIB_CB_NORMALIZE_IMAGE;
  if (!cv::findChessboardCornersSB(gray, {3, 3}, corners, flags | cv::CALIB_CB_LARGER, meta) ||
      static_cast<int>(corners.size()) < kFewestChessCorners)
    return std::nullopt;
  // Growing from a few corners may end too early; a part of a board is not found by its size.
  if (!cv::findChessboardCornersSB(gray, meta.size(), corners, flags) ||
      !IsPlain(gray, corners, meta.size()))
    return std::nullopt;
  Board board;
  board.columns = std::max(meta.cols, meta.rows);
  board.rows = std::min(meta.cols, meta.rows);
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

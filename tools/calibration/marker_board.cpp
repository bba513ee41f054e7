#include "tools/calibration/marker_board.h"

#include <algorithm>
#include <cmath>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>

#include "core/errors.h"
#include "tools/calibration/marker_dictionaries.h"

namespace mocap {
namespace {

constexpr int kFewestMarkerCorners = 6;
// A share that is wrong by less does not move corners: markers on both sides of each balance.
constexpr double kCharucoShareTolerance = 0.08, kTagShareTolerance = 0.025;
constexpr int kSmallPicture_px = 2000;
// Wider than any tag's border is in the doubled picture.
constexpr int kSurroundings_px = 201;
constexpr double kDarkerThanSurroundings = 5;
constexpr double kWindowShare = 0.14;  // Of a marker's side; a border of two bits is 0.2.
constexpr int kWidestMarkerWindow_px = 6;
constexpr double kFarthestTagCorner_px = 4;
const cv::TermCriteria kMarkerPrecision(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 1e-3);

Vector2 ToVector(const cv::Point2f& p) { return {p.x, p.y}; }
cv::Point2f ToPoint(const Vector2& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y())};
}

double SideOf(const Marker& marker) {
  double shortest_px = HUGE_VAL;
  for (std::size_t k = 0; k < 4; ++k)
    shortest_px = std::min(shortest_px, (marker.corners[(k + 1) % 4] - marker.corners[k]).norm());
  return shortest_px;
}

// Moves corners to the crossing of the edges; returns false if one is not there.
bool RefineMarker(const cv::Mat& gray, Marker& marker) {
  const int half_px = std::clamp(static_cast<int>(std::lround(kWindowShare * SideOf(marker))), 2,
                                 kWidestMarkerWindow_px);
  std::vector<cv::Point2f> corners;
  for (const Vector2& corner : marker.corners) corners.push_back(ToPoint(corner));
  cv::cornerSubPix(gray, corners, {half_px, half_px}, {-1, -1}, kMarkerPrecision);
  bool near = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector2 refined = ToVector(corners[k]);
    near = near && (refined - marker.corners[k]).norm() < kFarthestTagCorner_px;
    marker.corners[k] = refined;
  }
  return near;
}

cv::Ptr<cv::aruco::CharucoBoard> MakeCharuco(const Board& board, const MarkerGrid& grid) {
  const cv::Ptr<cv::aruco::CharucoBoard> charuco = cv::aruco::CharucoBoard::create(
      board.columns + 1, board.rows + 1, static_cast<float>(board.square_mm),
      static_cast<float>(board.square_mm * board.marker_share), DictionaryOf(board.dictionary));
  if (grid.layout == MarkerGrid::Layout::kBlackFirst) return charuco;
  const MarkerGrid newer{MarkerGrid::Layout::kBlackFirst, grid.columns};
  for (auto& near : charuco->nearestMarkerIdx) near.clear();
  for (auto& near : charuco->nearestMarkerCorners) near.clear();
  for (int id = 0; id < static_cast<int>(charuco->objPoints.size()); ++id) {
    const Vector2 place = grid.PlaceOf(id);
    const cv::Point2f moved = ToPoint((place - newer.PlaceOf(id)) * board.square_mm);
    for (int k = 0; k < 4; ++k) {
      charuco->objPoints[id][k] += cv::Point3f(moved.x, moved.y, 0);
      const int column = static_cast<int>(place.x() + (k == 1 || k == 2 ? 0.5 : -0.5)) - 1;
      const int row = static_cast<int>(place.y() + (k >= 2 ? 0.5 : -0.5)) - 1;
      if (column < 0 || row < 0 || column >= board.columns || row >= board.rows) continue;
      charuco->nearestMarkerIdx[row * board.columns + column].push_back(id);
      charuco->nearestMarkerCorners[row * board.columns + column].push_back(k);
    }
  }
  return charuco;
}

BoardCorners CharucoCorners(const cv::Mat& gray, const Board& board, const MarkerGrid& grid,
                            const std::vector<Marker>& markers) {
  std::vector<std::vector<cv::Point2f>> quads;
  std::vector<int> marker_ids, ids;
  for (const Marker& marker : markers) {
    marker_ids.push_back(marker.id);
    quads.emplace_back();
    for (const Vector2& corner : marker.corners) quads.back().push_back(ToPoint(corner));
  }
  std::vector<cv::Point2f> corners;
  cv::aruco::interpolateCornersCharuco(quads, marker_ids, gray, MakeCharuco(board, grid), corners,
                                       ids);
  BoardCorners found;
  found.ids = ids;
  // OpenCV counts these from the edge of the first pixel, all other corners from its middle.
  for (const cv::Point2f& corner : corners)
    found.pixels.push_back(ToVector(corner) - Vector2(0.5, 0.5));
  found.older_layout = grid.layout == MarkerGrid::Layout::kWhiteFirst;
  return found;
}

BoardCorners TagCorners(const Board& board, const MarkerGrid& grid,
                        const std::vector<Marker>& markers) {
  BoardCorners found;
  for (const Marker& marker : markers) {
    const int column = 2 * (marker.id % grid.columns), row = 2 * (marker.id / grid.columns);
    for (int k = 0; k < 4; ++k) {
      const int right = k == 1 || k == 2 ? 1 : 0, up = k < 2 ? 1 : 0;
      found.ids.push_back((row + up) * board.columns + column + right);
      found.pixels.push_back(marker.corners[static_cast<std::size_t>((k + grid.turn()) % 4)]);
    }
  }
  return found;
}

bool OnOneLine(const Board& board, const std::vector<int>& ids) {
  const auto same = [&](auto part) {
    return std::ranges::all_of(ids, [&](int id) { return part(id) == part(ids[0]); });
  };
  return same([&](int id) { return id / board.columns; }) ||
         same([&](int id) { return id % board.columns; });
}

// Black and white, twice as large if small, and with gaps where the squares of a grid touch the
// tags, whose outlines would be one.
cv::Mat SeparateTags(const cv::Mat& gray, bool doubled) {
  cv::Mat larger = gray, bright;
  if (doubled) cv::resize(gray, larger, {}, 2, 2, cv::INTER_CUBIC);
  cv::adaptiveThreshold(larger, bright, 255, cv::ADAPTIVE_THRESH_MEAN_C, cv::THRESH_BINARY,
                        kSurroundings_px, kDarkerThanSurroundings);
  const cv::Mat cross = cv::getStructuringElement(cv::MORPH_CROSS, {3, 3});
  cv::morphologyEx(bright, bright, cv::MORPH_CLOSE, cross);
  return bright;
}

}  // namespace

std::vector<Marker> FindMarkers(const cv::Mat& gray, const std::string& dictionary,
                                MarkerStyle style) {
  auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_NONE;
  const bool is_grid = style == MarkerStyle::kAprilGrid;
  const bool doubled = is_grid && std::max(gray.cols, gray.rows) <= kSmallPicture_px;
  if (is_grid) parameters->markerBorderBits = 2;
  std::vector<std::vector<cv::Point2f>> quads;
  std::vector<int> ids;
  cv::aruco::detectMarkers(is_grid ? SeparateTags(gray, doubled) : gray, DictionaryOf(dictionary),
                           quads, ids, parameters);
  std::vector<Marker> markers;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Marker marker{ids[i], {}};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector2 corner = ToVector(quads[i][k]);
      // Middles of pixels have whole coordinates.
      marker.corners[k] = doubled ? Vector2((corner.array() + 0.5) / 2 - 0.5) : corner;
    }
    if (!is_grid || RefineMarker(gray, marker)) markers.push_back(marker);
  }
  return markers;
}

double MeasureMarkerShare(const cv::Mat& gray, const MarkerGrid& grid,
                          const std::vector<Marker>& markers, MarkerStyle style) {
  std::vector<Marker> refined = markers;
  if (style == MarkerStyle::kCharuco) {
    for (Marker& marker : refined) {
      Marker moved = marker;
      if (RefineMarker(gray, moved)) marker = moved;
    }
  }
  const auto match = MatchGrid(grid, refined);
  return match ? match->marker_share : 0;
}

bool IsMarkerShare(double measured, const Board& board) {
  return std::abs(measured - board.marker_share) <
         (board.kind == BoardKind::kCharuco ? kCharucoShareTolerance : kTagShareTolerance);
}

int MarkersOf(const Board& board) {
  return board.kind == BoardKind::kAprilGrid ? board.corners() / 4
                                             : (board.columns + 1) * (board.rows + 1) / 2;
}

std::optional<BoardCorners> DetectMarkerBoard(const cv::Mat& gray, const Board& board) {
  const MarkerStyle style =
      board.kind == BoardKind::kAprilGrid ? MarkerStyle::kAprilGrid : MarkerStyle::kCharuco;
  const std::vector<Marker> markers = FindMarkers(gray, board.dictionary, style);
  std::optional<GridMatch> match;
  MarkerGrid grid;
  bool fits_both = false;
  for (const MarkerGrid& candidate : GridsOf(board)) {
    auto with = MatchGrid(candidate, markers);
    fits_both = with && match && with->pairs == match->pairs;
    if (!with || (match && match->pairs >= with->pairs)) continue;
    match = std::move(with);
    grid = candidate;
  }
  if (!match || match->last_id >= MarkersOf(board)) return std::nullopt;
  const bool even_rows = board.rows % 2 == 1;  // Of squares.
  if (grid.layout == MarkerGrid::Layout::kWhiteFirst && !even_rows) return std::nullopt;
  if (!IsMarkerShare(MeasureMarkerShare(gray, grid, match->markers, style), board))
    return std::nullopt;
  BoardCorners found = board.kind == BoardKind::kAprilGrid
                           ? TagCorners(board, grid, match->markers)
                           : CharucoCorners(gray, board, grid, match->markers);
  found.layout_open = fits_both && even_rows;
  const bool enough =
      static_cast<int>(found.ids.size()) >= kFewestMarkerCorners && !OnOneLine(board, found.ids);
  return enough ? std::optional(std::move(found)) : std::nullopt;
}

}  // namespace mocap

#include "tools/calibration/marker_grid.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/quantile.h"

namespace mocap {
namespace {

constexpr double kNeighbours = 2.1;        // Squares or tags.
constexpr double kFarthestOff = 0.35;      // Of the same.
constexpr double kLeastPairsAgree = 0.75;  // Share of pairs: some markers are misread.
constexpr int kFewestPairs = 3, kFewestAcrossRows = 2;
constexpr int kMostColumns = 50;

using Matrix2 = Eigen::Matrix2d;

// A marker's sides in the picture, along x and y of its board.
Matrix2 SidesOf(const Marker& marker, const MarkerGrid& grid) {
  const auto& c = marker.corners;
  Matrix2 sides;
  sides << (c[1] - c[0] + c[2] - c[3]) / 2, (c[3] - c[0] + c[2] - c[1]) / 2;
  return grid.turn() == 0 ? sides : Matrix2(-sides);
}

Vector2 MiddleOf(const Marker& marker) {
  const auto& c = marker.corners;
  return (c[0] + c[1] + c[2] + c[3]) / 4;
}

// From one marker to the next, by the grid and by the picture, in the markers' mean sides.
struct Step {
  Vector2 expected, seen;
  std::size_t from = 0, to = 0;
};

std::vector<Step> StepsBetween(const MarkerGrid& grid, const std::vector<Marker>& markers) {
  std::vector<Step> steps;
  for (std::size_t i = 0; i < markers.size(); ++i) {
    for (std::size_t j = i + 1; j < markers.size(); ++j) {
      const Vector2 expected = grid.PlaceOf(markers[j].id) - grid.PlaceOf(markers[i].id);
      if (expected.norm() > kNeighbours || expected.norm() < 0.5) continue;
      const Matrix2 sides = (SidesOf(markers[i], grid) + SidesOf(markers[j], grid)) / 2;
      if (std::abs(sides.determinant()) < 1) continue;
      steps.push_back(
          {expected, sides.inverse() * (MiddleOf(markers[j]) - MiddleOf(markers[i])), i, j});
    }
  }
  return steps;
}

}  // namespace

Vector2 MarkerGrid::PlaceOf(int id) const {
  if (layout == Layout::kTags) return {id % columns, -(id / columns)};
  const int first = layout == Layout::kBlackFirst ? 1 : 0;
  const int upper = (columns + 1 - first) / 2;  // Markers in the first of two rows.
  const int row = id / columns * 2, in_two = id % columns;
  if (in_two < upper) return {2 * in_two + first + 0.5, row + 0.5};
  return {2 * (in_two - upper) + 1 - first + 0.5, row + 1.5};
}

std::vector<MarkerGrid> GridsOf(const Board& board) {
  using Layout = MarkerGrid::Layout;
  if (board.kind == BoardKind::kAprilGrid) return {{Layout::kTags, board.columns / 2}};
  return {{Layout::kBlackFirst, board.columns + 1}, {Layout::kWhiteFirst, board.columns + 1}};
}

std::optional<GridMatch> MatchGrid(const MarkerGrid& grid, const std::vector<Marker>& markers) {
  const std::vector<Step> steps = StepsBetween(grid, markers);
  if (static_cast<int>(steps.size()) < kFewestPairs) return std::nullopt;
  std::vector<double> shares;
  for (const Step& step : steps) shares.push_back(step.expected.norm() / step.seen.norm());
  GridMatch match;
  match.marker_share = MedianOf(shares);
  int across_rows = 0;
  std::vector<int> votes(markers.size(), 0);
  for (const Step& step : steps) {
    const bool good = (match.marker_share * step.seen - step.expected).norm() < kFarthestOff;
    for (const std::size_t i : {step.from, step.to}) votes[i] += good ? 1 : -1;
    match.pairs += good;
    across_rows += good && step.expected.y() != 0;
  }
  for (std::size_t i = 0; i < markers.size(); ++i) {
    if (votes[i] <= 0) continue;
    match.markers.push_back(markers[i]);
    match.last_id = std::max(match.last_id, markers[i].id);
  }
  const bool agrees = match.pairs >= kFewestPairs && across_rows >= kFewestAcrossRows &&
                      match.pairs >= kLeastPairsAgree * static_cast<double>(steps.size()) &&
                      match.marker_share < 1.05;
  return agrees ? std::optional(match) : std::nullopt;
}

std::optional<MarkerGrid> FindGrid(const std::vector<Marker>& markers) {
  std::optional<MarkerGrid> best;
  int most_pairs = 0;
  for (const auto layout : {MarkerGrid::Layout::kBlackFirst, MarkerGrid::Layout::kWhiteFirst,
                            MarkerGrid::Layout::kTags}) {
    for (int columns = 2; columns <= kMostColumns; ++columns) {
      const MarkerGrid grid{layout, columns};
      const auto match = MatchGrid(grid, markers);
      if (!match || match->pairs <= most_pairs) continue;
      most_pairs = match->pairs;
      best = grid;
    }
  }
  return best;
}

}  // namespace mocap

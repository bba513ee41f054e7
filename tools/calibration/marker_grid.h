// Which markers of a board lie where, told from their numbers and places in a picture.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/geometry.h"
#include "tools/calibration/board.h"

namespace mocap {

/// A marker found in a picture.
struct Marker {
  int id = 0;
  std::array<Vector2, 4> corners;  ///< From the upper left one of its code, clockwise [px].
};

/// Order of the markers of a board, which is that of their numbers.
struct MarkerGrid {
  enum class Layout {
    kBlackFirst,  ///< ChArUco; the upper left square is black.
    kWhiteFirst,  ///< ChArUco; the upper left square has marker 0.
    kTags         ///< A grid of tags, numbered from the lower left; each turned by half a turn.
  };
  Layout layout = Layout::kBlackFirst;
  int columns = 0;  ///< Squares or tags across.

  /// Middle of a marker: in squares from the upper left corner, x right and y down; in tags from
  /// the first one, y up the grid and negative.
  Vector2 PlaceOf(int id) const;
  /// Corner 0 to 3 of a marker from the upper left one of the board, clockwise, where its code has
  /// corner (k + this) % 4.
  int turn() const { return layout == Layout::kTags ? 2 : 0; }
};

/// Grids with the board's number of columns, whether the board can have them or not.
std::vector<MarkerGrid> GridsOf(const Board& board);

/// How well markers in a picture agree with a grid.
struct GridMatch {
  /// Pairs of neighbouring markers that lie as they should. No lens is known, so only neighbours
  /// are compared.
  int pairs = 0;
  double marker_share = 0;      ///< Side of a marker over the distance of squares or tags.
  std::vector<Marker> markers;  ///< Without those that were misread or have no neighbour.
  int last_id = 0;
};

/// Compares markers with a grid. Empty if they do not agree, or too few neighbours are seen.
std::optional<GridMatch> MatchGrid(const MarkerGrid& grid, const std::vector<Marker>& markers);

/// Finds the grid that markers agree with best. Empty if there is none.
std::optional<MarkerGrid> FindGrid(const std::vector<Marker>& markers);

}  // namespace mocap

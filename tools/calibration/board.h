// A calibration target: a flat board with known corners, or a wand with two lights.
#pragma once

#include <string>
#include <vector>

#include "core/geometry.h"

namespace mocap {

enum class BoardKind { kChessboard, kCharuco, kAprilGrid, kWand };

/// A board, as printed and measured.
struct Board {
  BoardKind kind = BoardKind::kChessboard;
  /// Number of inner corners across and down. (ChArUco boards are named by their squares, one more
  /// each way.) Of a grid of tags: of the tags' corners, two for each tag each way.
  int columns = 0;
  int rows = 0;
  /// Side of a square. For a wand: distance of the lights; it is 2 x 1. For a grid of tags: from
  /// the edge of a tag to that of the next.
  double square_mm = 0;
  std::string dictionary = "DICT_4X4_50";  ///< Of the markers, if any: OpenCV's name.
  double marker_share = 0.75;              ///< Side of a marker over the side of a square.
  bool inverted = false;                   ///< Printed white on black.
  /// ChArUco with an even number of rows of squares only: as OpenCV printed them before 4.6, and
  /// others still do; the lower left square is black, not the upper left. Told from the pictures.
  bool older_layout = false;

  int corners() const { return columns * rows; }
  bool HasMarkers() const { return kind == BoardKind::kCharuco || kind == BoardKind::kAprilGrid; }
  /// p_BQ of a corner [mm]: x along a row, y down the columns, z into the board (seen from the
  /// front, x is right and y is down). A grid of tags begins at its lower left corner, as Kalibr's
  /// do: its corners have y <= 0.
  Vector3 Corner(int id) const;
  /// Whether the board is a chessboard that looks the same after half a turn.
  bool LooksSameTurned() const { return kind == BoardKind::kChessboard && columns % 2 == rows % 2; }
  /// Description for people: "chessboard of 8 x 6 inner corners, squares of 115 mm".
  std::string Text() const;
  /// As ParseBoard reads it; lengths that are not known are "MM".
  std::string Spec() const;
};

/// Parses `chess:8x6:115` (inner corners, mm), `charuco:4x5:54[:DICT_4X4_50][:0.75][:inverted]`
/// (squares, mm, dictionary, marker over square), `aprilgrid:6x6:88:0.3` (tags, mm, gap over tag)
/// or `wand:500` (distance of the lights in mm).
/// @throws SetupError  stating the expected format; for a dictionary that does not exist or has too
/// few markers.
Board ParseBoard(const std::string& text);

/// Detected corners of a board in one picture.
struct BoardCorners {
  std::vector<int> ids;
  std::vector<Vector2> pixels;  ///< One for each id.
  bool older_layout = false;    ///< As of Board.
  /// The markers that are seen fit both layouts. Then corners are those of the newer one; in the
  /// older one, each is that before.
  bool layout_open = false;
};

}  // namespace mocap

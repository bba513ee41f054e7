// A calibration target: a flat board whose corners are known, or a wand with two lights.
#pragma once

#include <string>
#include <vector>

#include "core/geometry.h"

namespace mocap {

enum class BoardKind { kChessboard, kCharuco, kWand };

/// A board as it was printed and measured.
struct Board {
  BoardKind kind = BoardKind::kChessboard;
  /// Inner corners across and down. (A ChArUco board is named by its squares, one more each way.)
  int columns = 0;
  int rows = 0;
  double square_mm = 0;                    ///< Of a wand: from light to light; it is 2 x 1.
  std::string dictionary = "DICT_4X4_50";  ///< ChArUco only, OpenCV's name.
  double marker_share = 0.75;              ///< Side of a marker over the side of a square.
  bool inverted = false;                   ///< Printed white on black.

  int corners() const { return columns * rows; }
  /// p_BQ of a corner [mm]: x along a row, y down the columns, z into the board (x right and y down
  /// as one looks at it).
  Vector3 Corner(int id) const {
    return {(id % columns) * square_mm, (id / columns) * square_mm, 0.0};
  }
  /// True of a chessboard that looks the same when it is turned by half a turn.
  bool LooksSameTurned() const { return kind == BoardKind::kChessboard && columns % 2 == rows % 2; }
  /// As a person says it: "chessboard of 8 x 6 inner corners, squares of 115 mm".
  std::string Text() const;
};

/// Reads `chess:8x6:115` (inner corners, mm), `charuco:4x5:54[:DICT_4X4_50][:0.75][:inverted]`
/// (squares, mm, dictionary, marker over square) or `wand:500` (mm from light to light).
/// @throws SetupError  saying what is wanted.
Board ParseBoard(const std::string& text);

/// One picture's corners of a board.
struct BoardCorners {
  std::vector<int> ids;
  std::vector<Vector2> pixels;  ///< One for each id.
};

}  // namespace mocap

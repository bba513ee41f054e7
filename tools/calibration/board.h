// A calibration target: a flat board with known corners, or a wand with two lights.
#pragma once

#include <string>
#include <vector>

#include "core/geometry.h"

namespace mocap {

enum class BoardKind { kChessboard, kCharuco, kWand };

/// A board, as printed and measured.
struct Board {
  BoardKind kind = BoardKind::kChessboard;
  /// Number of inner corners across and down. (ChArUco boards are named by their squares, one more
  /// each way.)
  int columns = 0;
  int rows = 0;
  double square_mm = 0;                    ///< For a wand: distance of the lights; it is 2 x 1.
  std::string dictionary = "DICT_4X4_50";  ///< ChArUco only, OpenCV's name.
  double marker_share = 0.75;              ///< Side of a marker over the side of a square.
  bool inverted = false;                   ///< Printed white on black.

  int corners() const { return columns * rows; }
  /// p_BQ of a corner [mm]: x along a row, y down the columns, z into the board (seen from the
  /// front, x is right and y is down).
  Vector3 Corner(int id) const {
    return {(id % columns) * square_mm, (id / columns) * square_mm, 0.0};
  }
  /// Whether the board is a chessboard that looks the same after half a turn.
  bool LooksSameTurned() const { return kind == BoardKind::kChessboard && columns % 2 == rows % 2; }
  /// Description for people: "chessboard of 8 x 6 inner corners, squares of 115 mm".
  std::string Text() const;
};

/// Parses `chess:8x6:115` (inner corners, mm), `charuco:4x5:54[:DICT_4X4_50][:0.75][:inverted]`
/// (squares, mm, dictionary, marker over square) or `wand:500` (distance of the lights in mm).
/// @throws SetupError  stating the expected format.
Board ParseBoard(const std::string& text);

/// Detected corners of a board in one picture.
struct BoardCorners {
  std::vector<int> ids;
  std::vector<Vector2> pixels;  ///< One for each id.
};

}  // namespace mocap

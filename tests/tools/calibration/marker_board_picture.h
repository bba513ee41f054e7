// Pictures of boards with markers, drawn square by square with the markers of OpenCV.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/tools/calibration/board_picture.h"
#include "tools/calibration/marker_dictionaries.h"

namespace mocap::testing {

constexpr int kPrintSquare_px = 120, kPrintTag_px = 100;

/// Squares or tags of the print are so far apart.
inline int PrintPitchPx(const Board& board) {
  return board.kind == BoardKind::kAprilGrid
             ? static_cast<int>(std::lround(kPrintTag_px / board.marker_share))
             : kPrintSquare_px;
}

/// Draws the bits of a marker, black border included; 1 is white.
inline cv::Mat BitsOf(const std::string& dictionary, int id, int border_bits) {
  const auto markers = DictionaryOf(dictionary);
  cv::Mat bits;
  markers->drawMarker(id, markers->markerSize + 2 * border_bits, bits, border_bits);
  return bits;
}

inline void PutMarker(const cv::Mat& bits, double left, double top, double side, bool turned,
                      cv::Mat& print) {
  for (int y = static_cast<int>(top); y < top + side; ++y) {
    for (int x = static_cast<int>(left); x < left + side; ++x) {
      const int column = static_cast<int>((x - left + 0.5) / side * bits.cols);
      const int row = static_cast<int>((y - top + 0.5) / side * bits.rows);
      const bool white = turned ? bits.at<std::uint8_t>(bits.rows - 1 - row, bits.cols - 1 - column)
                                : bits.at<std::uint8_t>(row, column);
      print.at<std::uint8_t>(y, x) = white ? 225 : 35;
    }
  }
}

/// The printed sheet with a white rim of one square.
inline cv::Mat PrintCharuco(const Board& board) {
  const int columns = board.columns + 1, rows = board.rows + 1, side = kPrintSquare_px;
  cv::Mat print((rows + 2) * side, (columns + 2) * side, CV_8U, cv::Scalar(225));
  const double marker = side * board.marker_share;
  int id = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const int left = (x + 1) * side, top = (y + 1) * side;
      // In the older layout rows count from below.
      if ((x + (board.older_layout ? rows - 1 - y : y)) % 2 == 0) {
        print(cv::Rect(left, top, side, side)).setTo(35);
      } else {
        const double gap = std::round((side - marker) / 2);
        PutMarker(BitsOf(board.dictionary, id++, 1), left + gap, top + gap, marker, false, print);
      }
    }
  }
  return print;
}

/// A grid as Kalibr prints it, with a rim of one tag: borders of two bits, numbers from the lower
/// left, black squares at the corners. OpenCV has the same codes, turned by half a turn.
inline cv::Mat PrintAprilGrid(const Board& board) {
  const int columns = board.columns / 2, rows = board.rows / 2;
  const int pitch = PrintPitchPx(board), tag = kPrintTag_px, gap = pitch - tag;
  cv::Mat print((rows + 2) * pitch, (columns + 2) * pitch, CV_8U, cv::Scalar(225));
  for (int id = 0; id < columns * rows; ++id) {
    const int left = (id % columns + 1) * pitch, top = (rows - id / columns) * pitch;
    PutMarker(BitsOf(board.dictionary, id, 2), left, top, tag, true, print);
    for (const int x : {left - gap, left + tag}) {
      for (const int y : {top - gap, top + tag}) print(cv::Rect(x, y, gap, gap)).setTo(35);
    }
  }
  return print;
}

/// Paints a board with markers as a camera sees it.
inline Image<Bgr> PaintMarkerBoard(const CameraCalibration& camera, const RigidTransform& X_CB,
                                   const Board& board) {
  const bool is_grid = board.kind == BoardKind::kAprilGrid;
  const cv::Mat print = is_grid ? PrintAprilGrid(board) : PrintCharuco(board);
  const int pitch_px = PrintPitchPx(board);
  const double px_per_mm = pitch_px / board.square_mm;
  // Where the board's first corner is printed.
  const Vector2 first_px = is_grid ? Vector2(pitch_px, board.rows / 2 * pitch_px + kPrintTag_px)
                                   : Vector2(2 * pitch_px, 2 * pitch_px);
  const Vector2 size_px(print.cols, print.rows);
  const Eigen::AlignedBox2d sheet(-first_px / px_per_mm,
                                  (size_px - first_px - Vector2(1e-3, 1e-3)) / px_per_mm);
  return PaintPlane(camera, X_CB, sheet, [&](const Vector2& at_mm) {
    const Vector2 at = at_mm * px_per_mm + first_px;
    const std::uint8_t value =
        print.at<std::uint8_t>(static_cast<int>(at.y()), static_cast<int>(at.x()));
    return static_cast<double>(board.inverted ? 255 - value : value);
  });
}

}  // namespace mocap::testing

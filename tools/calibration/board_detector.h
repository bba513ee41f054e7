// Detection of a board's corners in a picture.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/image.h"
#include "tools/calibration/board.h"

namespace mocap {

/// Effort spent on a picture.
enum class Effort {
  kQuick,    ///< One of many frames.
  kThorough  ///< The only one: also search for a board that is far away or seen at a low angle.
};

/// Why a picture shows no valid board.
struct BoardMismatch {
  std::string text;      ///< With the remedy.
  int corners_seen = 0;  ///< Of what is there instead; a picture with more of them tells more.
};

/// Detects one kind of board. Thread-bound.
class BoardDetector {
 public:
  explicit BoardDetector(const Board& board);
  ~BoardDetector();
  BoardDetector(BoardDetector&&) noexcept;

  /// Finds corners with subpixel accuracy. Empty if the board is not visible, or too blurred for
  /// its corners to be located. A chessboard must be complete; boards with markers need at least
  /// six corners, and markers that lie as on this board. For a wand, returns all lights: see
  /// KeepWands.
  std::optional<BoardCorners> Detect(ImageView<const Bgr> image, Effort effort) const;

  /// Explains why a picture shows no valid board, and the remedy: it is another board than
  /// expected, blurred, mirrored or inverted. Empty if nothing similar is visible.
  std::optional<BoardMismatch> WhyNot(ImageView<const Bgr> image) const;

  /// Returns what is there instead, where Detect takes part of another board for a chessboard.
  std::optional<BoardMismatch> WhyNotAfterAll(ImageView<const Bgr> image) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap

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

/// Detects one kind of board. Thread-bound.
class BoardDetector {
 public:
  /// @throws SetupError  for a dictionary that OpenCV does not have or that has too few markers.
  explicit BoardDetector(const Board& board);
  ~BoardDetector();
  BoardDetector(BoardDetector&&) noexcept;

  /// Finds corners with subpixel accuracy. Empty if the board is not visible, or too blurred for
  /// its corners to be located. A chessboard must be complete; a ChArUco board needs at least six
  /// corners. For a wand, returns all lights: see KeepWands.
  std::optional<BoardCorners> Detect(ImageView<const Bgr> image, Effort effort) const;

  /// Explains why a picture shows no valid board, and the remedy: it is blurred, mirrored, inverted
  /// or of another size. Empty if nothing similar is visible.
  std::string WhyNot(ImageView<const Bgr> image) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap

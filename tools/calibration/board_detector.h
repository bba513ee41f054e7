// Finds a board's corners in a picture.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/image.h"
#include "tools/calibration/board.h"

namespace mocap {

/// How much time a picture is worth.
enum class Effort {
  kQuick,    ///< One of many frames.
  kThorough  ///< The only one: a board seen from low down or far away is looked for, too.
};

/// Detects one kind of board. Thread-bound.
class BoardDetector {
 public:
  /// @throws SetupError  for a dictionary that OpenCV does not have or that has too few markers.
  explicit BoardDetector(const Board& board);
  ~BoardDetector();
  BoardDetector(BoardDetector&&) noexcept;

  /// Finds corners to a fraction of a pixel; empty when the board is not seen, or is blurred so
  /// much that its corners have no place. A chessboard is found whole or not at all; of a ChArUco
  /// board at least six corners are wanted. Of a wand all lights are given: see KeepWands.
  std::optional<BoardCorners> Detect(ImageView<const Bgr> image, Effort effort) const;

  /// Tells what is wrong with a picture in which no board is found, and what to do: it is blurred,
  /// mirrored, printed the other way round, or of another size. Empty when nothing like it is seen.
  std::string WhyNot(ImageView<const Bgr> image) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap

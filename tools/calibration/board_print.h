// A board as it is printed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/calibration/board.h"

namespace mocap {

/// A rectangle of one color, from the upper left corner of the sheet, x right and y down [mm].
struct PrintedPatch {
  Vector2 at_mm, size_mm;
  bool is_black = false;
};

/// What is printed of a board: patches, each over those before.
struct BoardPrint {
  Vector2 size_mm = Vector2::Zero();          ///< With the rim that detectors need.
  Vector2 first_corner_mm = Vector2::Zero();  ///< Where corner 0 of the board lies.
  std::vector<PrintedPatch> patches;
};

/// Lays out a board. Of the two layouts of ChArUco, it takes the newer one.
/// @throws SetupError  for a wand.
BoardPrint PrintOf(const Board& board);

/// Parses a page: `a0` to `a5`, or `WIDTHxHEIGHT` in mm.
/// @return  its sides [mm].
/// @throws SetupError
Vector2 ParsePage(const std::string& text);

/// Writes a PDF of one page with the board in its true size, and a ruler to check the print.
/// @param page_mm  sides of the page, in any order; zero for one as large as needed.
/// @throws SetupError  if the page is too small, or the file is no PDF or cannot be written.
void WriteBoardPdf(const std::filesystem::path& file, const Board& board, const Vector2& page_mm);

}  // namespace mocap

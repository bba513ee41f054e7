#include "tools/calibration/board.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "core/errors.h"
#include "drivers/quoted.h"

namespace mocap {
namespace {

[[noreturn]] void Refuse(const std::string& text, const std::string& why) {
  throw SetupError("--board " + Quoted(text) + ": " + why +
                   "; expected chess:COLUMNSxROWS:MM (inner corners), "
                   "charuco:COLUMNSxROWS:MM[:DICTIONARY][:MARKER_SHARE][:inverted] (squares) or "
                   "wand:MM (from light to light)");
}

bool ReadNumber(const std::string& text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

void ReadSize(const std::string& text, const std::string& size, Board& board) {
  const std::vector<std::string> sides = Split(size, 'x');
  double columns = 0, rows = 0;
  if (sides.size() != 2 || !ReadNumber(sides[0], columns) || !ReadNumber(sides[1], rows))
    Refuse(text, Quoted(size) + " is not a size");
  const auto whole = [](double n) { return n == static_cast<int>(n) && n >= 3 && n <= 50; };
  if (!whole(columns) || !whole(rows)) Refuse(text, Quoted(size) + " is not 3 to 50 each way");
  board.columns = static_cast<int>(columns);
  board.rows = static_cast<int>(rows);
}

}  // namespace

std::string Board::Text() const {
  if (kind == BoardKind::kWand) return fmt::format("wand with lights {} mm apart", square_mm);
  if (kind == BoardKind::kChessboard)
    return fmt::format("chessboard of {} x {} inner corners, squares of {} mm", columns, rows,
                       square_mm);
  return fmt::format("ChArUco board of {} x {} squares of {} mm, {}{}", columns + 1, rows + 1,
                     square_mm, dictionary, inverted ? ", inverted" : "");
}

Board ParseBoard(const std::string& text) {
  const std::vector<std::string> parts = Split(text, ':');
  if (parts.size() == 2 && parts[0] == "wand") {
    Board wand{BoardKind::kWand, 2, 1, 0, "", 0, false};
    if (!ReadNumber(parts[1], wand.square_mm) || !(wand.square_mm >= 50 && wand.square_mm <= 3000))
      Refuse(text, Quoted(parts[1]) + " is not a wand's length of 50 to 3000 mm");
    return wand;
  }
  if (parts.size() < 3) Refuse(text, "has too few parts");
  Board board;
  if (parts[0] == "charuco") {
    board.kind = BoardKind::kCharuco;
  } else if (parts[0] != "chess") {
    Refuse(text, Quoted(parts[0]) + " is not a kind of board");
  }
  ReadSize(text, parts[1], board);
  if (!ReadNumber(parts[2], board.square_mm) || !(board.square_mm >= 1 && board.square_mm <= 2000))
    Refuse(text, Quoted(parts[2]) + " is not a square's side of 1 to 2000 mm");
  for (std::size_t i = 3; i < parts.size(); ++i) {
    double share = 0;
    if (board.kind != BoardKind::kCharuco) Refuse(text, "a chessboard has no " + Quoted(parts[i]));
    if (parts[i] == "inverted") {
      board.inverted = true;
    } else if (parts[i].starts_with("DICT_")) {
      board.dictionary = parts[i];
    } else if (ReadNumber(parts[i], share) && share > 0.1 && share < 1) {
      board.marker_share = share;
    } else {
      Refuse(text, Quoted(parts[i]) + " is not understood");
    }
  }
  if (board.kind == BoardKind::kCharuco) {
    --board.columns;
    --board.rows;
  }
  return board;
}

}  // namespace mocap

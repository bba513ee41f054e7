#include "tools/calibration/board.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "tools/calibration/marker_dictionaries.h"

namespace mocap {
namespace {

constexpr int kMostTagsAcross = 24;  // Kalibr's family has 587 tags.

[[noreturn]] void Refuse(const std::string& text, const std::string& why) {
  throw SetupError("--board " + Quoted(text) + ": " + why +
                   "; expected chess:COLUMNSxROWS:MM (inner corners), "
                   "charuco:COLUMNSxROWS:MM[:DICTIONARY][:MARKER_SHARE][:inverted] (squares), "
                   "aprilgrid:COLUMNSxROWS:TAG_MM:SPACING (tags; gap over tag) or "
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

void ReadSize(const std::string& text, const std::string& size, int fewest, int most,
              Board& board) {
  const std::vector<std::string> sides = Split(size, 'x');
  double columns = 0, rows = 0;
  if (sides.size() != 2 || !ReadNumber(sides[0], columns) || !ReadNumber(sides[1], rows))
    Refuse(text, Quoted(size) + " is not a size");
  const auto fits = [&](double n) { return n >= fewest && n <= most && n == static_cast<int>(n); };
  if (!fits(columns) || !fits(rows))
    Refuse(text, fmt::format("{} is not {} to {} each way", Quoted(size), fewest, most));
  board.columns = static_cast<int>(columns);
  board.rows = static_cast<int>(rows);
}

void ReadLength(const std::string& text, const std::string& length, const char* what,
                Board& board) {
  if (!ReadNumber(length, board.square_mm) || !(board.square_mm >= 1 && board.square_mm <= 2000))
    Refuse(text, Quoted(length) + " is not a " + what + "'s side of 1 to 2000 mm");
}

bool IsName(const std::string& part) {
  return !part.empty() && std::isalpha(static_cast<unsigned char>(part[0])) != 0;
}

std::string ReadDictionary(const std::string& part, int markers) {
  const std::string name = DictionaryName(part);
  if (name.empty())
    throw SetupError("--board: there is no dictionary " + Quoted(part) + "; " +
                     ExpectedNames(part, DictionaryNames()));
  const int has = DictionaryOf(name)->bytesList.rows;
  if (markers > has)
    throw SetupError(
        fmt::format("--board: {} has {} markers; the board has {}", name, has, markers));
  return name;
}

Board ParseWand(const std::string& text, const std::vector<std::string>& parts) {
  Board wand{BoardKind::kWand, 2, 1, 0, "", 0, false};
  if (!ReadNumber(parts[1], wand.square_mm) || !(wand.square_mm >= 50 && wand.square_mm <= 3000))
    Refuse(text, Quoted(parts[1]) + " is not a wand's length of 50 to 3000 mm");
  return wand;
}

Board ParseAprilGrid(const std::string& text, const std::vector<std::string>& parts) {
  Board grid;
  grid.kind = BoardKind::kAprilGrid;
  grid.dictionary = kAprilGridDictionary;
  ReadSize(text, parts[1], 2, kMostTagsAcross, grid);
  grid.columns *= 2;
  grid.rows *= 2;
  ReadLength(text, parts[2], "tag", grid);
  double spacing = 0;
  if (parts.size() != 4) Refuse(text, "a grid of tags has four parts");
  if (!ReadNumber(parts[3], spacing) || !(spacing >= 0.05 && spacing <= 1))
    Refuse(text, Quoted(parts[3]) + " is not a gap of 0.05 to 1 times the tag's side");
  grid.marker_share = 1 / (1 + spacing);
  grid.square_mm /= grid.marker_share;
  return grid;
}

Board ParseCharuco(const std::string& text, const std::vector<std::string>& parts) {
  Board board;
  board.kind = BoardKind::kCharuco;
  ReadSize(text, parts[1], 3, 50, board);
  ReadLength(text, parts[2], "square", board);
  std::string dictionary = board.dictionary;
  for (std::size_t i = 3; i < parts.size(); ++i) {
    double share = 0;
    if (parts[i] == "inverted") {
      board.inverted = true;
    } else if (IsName(parts[i])) {
      dictionary = parts[i];
    } else if (ReadNumber(parts[i], share) && share > 0.1 && share < 1) {
      board.marker_share = share;
    } else {
      Refuse(text, Quoted(parts[i]) + " is not understood");
    }
  }
  board.dictionary = ReadDictionary(dictionary, board.columns * board.rows / 2);
  --board.columns;
  --board.rows;
  return board;
}

// Without trailing zeros.
std::string LengthText(double mm) {
  return mm > 0 ? fmt::format("{:g}", std::round(mm * 1000) / 1000) : "MM";
}

double SpacingOf(const Board& grid) { return 1 / grid.marker_share - 1; }

}  // namespace

Vector3 Board::Corner(int id) const {
  const int across = id % columns, along = id / columns;
  if (kind != BoardKind::kAprilGrid) return {across * square_mm, along * square_mm, 0.0};
  const auto place = [this](int i) {
    return square_mm * (i / 2 + (i % 2 == 1 ? marker_share : 0));
  };
  return {place(across), -place(along), 0.0};
}

std::string Board::Text() const {
  if (kind == BoardKind::kWand) return fmt::format("wand with lights {} mm apart", square_mm);
  if (kind == BoardKind::kChessboard)
    return fmt::format("chessboard of {} x {} inner corners, squares of {} mm", columns, rows,
                       square_mm);
  if (kind == BoardKind::kAprilGrid)
    return fmt::format("grid of {} x {} AprilTags of {} mm, gaps of {} mm", columns / 2, rows / 2,
                       LengthText(square_mm * marker_share),
                       LengthText(square_mm * (1 - marker_share)));
  return fmt::format("ChArUco board of {} x {} squares of {} mm, {}{}{}", columns + 1, rows + 1,
                     square_mm, dictionary, inverted ? ", inverted" : "",
                     older_layout ? ", in the older layout of before OpenCV 4.6" : "");
}

std::string Board::Spec() const {
  if (kind == BoardKind::kWand) return "wand:" + LengthText(square_mm);
  if (kind == BoardKind::kChessboard)
    return fmt::format("chess:{}x{}:{}", columns, rows, LengthText(square_mm));
  if (kind == BoardKind::kAprilGrid)
    return fmt::format("aprilgrid:{}x{}:{}:{:.2g}", columns / 2, rows / 2,
                       LengthText(square_mm * marker_share), SpacingOf(*this));
  return fmt::format("charuco:{}x{}:{}:{}:{:.2g}{}", columns + 1, rows + 1, LengthText(square_mm),
                     dictionary, marker_share, inverted ? ":inverted" : "");
}

Board ParseBoard(const std::string& text) {
  const std::vector<std::string> parts = Split(text, ':');
  if (parts.size() == 2 && parts[0] == "wand") return ParseWand(text, parts);
  if (parts.size() < 3) Refuse(text, "has too few parts");
  if (parts[0] == "charuco") return ParseCharuco(text, parts);
  if (parts[0] == "aprilgrid") return ParseAprilGrid(text, parts);
  if (parts[0] != "chess") Refuse(text, Quoted(parts[0]) + " is not a kind of board");
  Board board;
  ReadSize(text, parts[1], 3, 50, board);
  ReadLength(text, parts[2], "square", board);
  if (parts.size() > 3) Refuse(text, "a chessboard has no " + Quoted(parts[3]));
  return board;
}

}  // namespace mocap
